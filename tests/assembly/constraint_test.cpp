// SPDX-License-Identifier: GPL-3.0-or-later
// Points, rigid and distributing couplings and equations against Lagrange multipliers.
#include <gtest/gtest.h>

#include "assembly/coupling/dof_numbers.hpp"
#include "assembly/coupling/member_group.hpp"
#include "assembly/coupling/rigid_coupling.hpp"
#include "bar_model.hpp"
#include "core/dense/cholesky.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

using test::expect_parts;

std::string constraint_refusal(const mesh::Mesh& mesh, const std::string& toml) {
  return test::refusal_of([&] { build(mesh, toml); });
}

TEST(RigidCoupling, FollowsItsReferenceLikeALever) {
  const std::vector<ReferencePoint> points = {{"p", {1.0, 0.0, 0.0}, -1}};
  const RowMatrix nodes = (RowMatrix(1, 3) << 1.0, 2.0, 0.0).finished();
  const DofNumbers numbers(nodes, points);
  ReferenceDofs reference;
  for (int d = 0; d < 6; ++d) reference.ids[d] = numbers.of_point(0, d);
  reference.position = points[0].position;
  const auto rows = rigid_dependences(numbers, NodeOrPoint::of_node(0), {0, 1, 2, 3}, reference);
  ASSERT_EQ(rows.size(), 3u);  // a node has no rotation
  // r = (0, 2, 0): u_x = p_x - 2 rz, u_y = p_y, u_z = p_z + 2 rx.
  EXPECT_EQ(rows[0].on.dofs, (std::vector<int32_t>{3, 8}));
  EXPECT_EQ(rows[0].on.values, (std::vector<double>{1.0, -2.0}));
  EXPECT_EQ(rows[1].on.dofs, (std::vector<int32_t>{4}));
  EXPECT_EQ(rows[2].on.values, (std::vector<double>{1.0, 2.0}));
}

TEST(RigidCoupling, WithItsOwnReferenceNodeEqualsTheMultipliers) {
  const mesh::Mesh mesh = bar();
  const fe::FeModel model = build(mesh, std::string(kFoot) + R"(
[[coupling]]
name = "hub"
type = "rigid"
surface = "z1"
point = [0.3, 0.0, 0.5]
)")
                                .model;
  ASSERT_EQ(model.set("hub").dofs.size(), 6u);
  const std::vector<ReferencePoint> points = {{"hub", {0.3, 0.0, 0.5}, -1}};
  const DofNumbers numbers(mesh.nodes, points);
  ReferenceDofs reference;
  for (int d = 0; d < 6; ++d) reference.ids[d] = numbers.of_point(0, d);
  reference.position = points[0].position;
  Saddle saddle(mesh, 1);
  hold_foot(mesh, saddle);
  for (const int32_t node : mesh.node_sets.at("z1"))
    for (const auto& row :
         rigid_dependences(numbers, NodeOrPoint::of_node(node), {0, 1, 2}, reference))
      saddle.add(row);
  Eigen::VectorXd f = some_forces(saddle.size());
  const Eigen::VectorXd want = saddle.solve(f);
  // The reference is a set here and no point: its forces act on the set's coordinates.
  Eigen::VectorXd q_forces = model.T.transpose() * f.head(numbers.nodal());
  for (int d = 0; d < 6; ++d) q_forces(model.set("hub").dofs[d]) += f(numbers.nodal() + d);
  const Eigen::VectorXd q = dense::Cholesky(full(model.K)).solve(q_forces);
  EXPECT_LT((model.T * q - want.head(numbers.nodal())).norm(), kSolve * want.norm());
  for (int d = 0; d < 6; ++d)
    EXPECT_NEAR(q(model.set("hub").dofs[d]), want(numbers.nodal() + d), kSolve * want.norm());
}

TEST(DistributingCoupling, OfWeightedNodesByHand) {
  // Two nodes on a line along x, weights 1 and 3: z of the middle reference is their mean, ry
  // their slope, rx is not defined.
  std::vector<Member> members(2);
  members[0] = {{0, 1, 2, -1, -1, -1}, {0.0, 0.0, 0.0}, 1.0};
  members[1] = {{3, 4, 5, -1, -1, -1}, {4.0, 0.0, 0.0}, 3.0};
  const Coupling coupling = distribute(members, {0.0, 0.0, 0.0}, {2, 4}, "test");
  // Fit through both: z = u_1, ry = -(u_2 - u_1) / 4.
  ASSERT_EQ(coupling.rows.size(), 2u);
  EXPECT_EQ(coupling.rows[1].dofs, (std::vector<int32_t>{2, 5}));
  EXPECT_NEAR(coupling.rows[1].values[0], 0.25, 1e-14);
  EXPECT_NEAR(coupling.rows[1].values[1], -0.25, 1e-14);
  const Coupling centre = distribute(members, {3.0, 0.0, 0.0}, {2}, "test");
  EXPECT_NEAR(centre.rows[0].values[0], 0.25, 1e-14);  // weights at the weighted centre
  EXPECT_NEAR(centre.rows[0].values[1], 0.75, 1e-14);
  expect_parts(test::refusal_of([&] {
                 distribute(members, {0.0, 0.0, 0.0}, {3}, "test");
               }),
               {"test: found nodes that do not define rx of the reference", "on a line"});
}

TEST(DistributingCoupling, CountsRotationsOfPointsByTheirExtent) {
  // Two points, their rotations about x too: the mean of both rotations.
  std::vector<Member> members(2);
  members[0] = {{0, 1, 2, 3, 4, 5}, {-1.0, 0.0, 0.0}, 1.0};
  members[1] = {{6, 7, 8, 9, 10, 11}, {1.0, 0.0, 0.0}, 1.0};
  const Coupling coupling = distribute(members, {0.0, 0.0, 0.0}, {3}, "test");
  EXPECT_EQ(coupling.rows[0].dofs, (std::vector<int32_t>{3, 9}));
  EXPECT_NEAR(coupling.rows[0].values[0], 0.5, 1e-14);
}

/// A chain: p1 is coupled to the end face, p2 follows p1 rigidly, p3 is coupled to p2 and two
/// nodes, and an equation ties node n50 to p3.
const std::vector<std::string> kChain = {R"(
[[coupling]]
point = "p1"
surface = "z1"
)",
                                         R"(
[[coupling]]
type = "rigid"
point = "p1"
points = ["p2"]
)",
                                         R"(
[[coupling]]
point = "p3"
directions = ["x", "z", "ry"]
[[coupling.term]]
points = ["p2"]
weight = 2.0
directions = ["x", "y", "z", "ry"]
[[coupling.term]]
node_set = "n0"
directions = "xyz"
[[coupling.term]]
node_set = "n100"
weight = 0.5
directions = "xyz"
)",
                                         R"(
[[equation]]
terms = [ { node_set = "n50", direction = "x", coefficient = 2.0 },
          { point = "p3", direction = "x", coefficient = -1.0 },
          { point = "p3", direction = "ry", coefficient = 0.1 } ]
)"};
constexpr const char* kChainPoints = R"(
[[point]]
name = "p1"
at = [0.05, 0.05, 0.4]
[[point]]
name = "p2"
at = [0.2, 0.05, 0.4]
[[point]]
name = "p3"
at = [0.1, 0.0, 0.25]
)";

class ChainInOrder : public ::testing::TestWithParam<std::vector<size_t>> {};
INSTANTIATE_TEST_SUITE_P(OfTables, ChainInOrder,
                         ::testing::Values(std::vector<size_t>{0, 1, 2, 3},
                                           std::vector<size_t>{3, 2, 1, 0},
                                           std::vector<size_t>{2, 0, 3, 1}));

TEST_P(ChainInOrder, EqualsTheMultipliers) {
  const mesh::Mesh mesh = bar();
  std::string toml = std::string(kFoot) + kChainPoints;
  for (const size_t part : GetParam()) toml += kChain[part];
  const fe::FeModel model = build(mesh, toml).model;

  const std::vector<ReferencePoint> points = {
      {"p1", {0.05, 0.05, 0.4}, -1}, {"p2", {0.2, 0.05, 0.4}, -1}, {"p3", {0.1, 0.0, 0.25}, -1}};
  const DofNumbers numbers(mesh.nodes, points);
  Saddle saddle(mesh, 3);
  hold_foot(mesh, saddle);
  const auto couple = [&](const std::vector<Member>& members, int32_t point,
                          const std::vector<int>& directions) {
    const Coupling coupling = distribute(members, points[point].position, directions, "test");
    const std::vector<Functional> rows = coupling.nodal_rows();
    for (size_t k = 0; k < rows.size(); ++k)
      saddle.add(Dependence{numbers.of_point(point, directions[k]), rows[k]});
  };
  couple(members_of(mesh.nodes, integrate_surface(mesh.nodes, mesh.surface("z1"))), 0,
         {0, 1, 2, 3, 4, 5});
  ReferenceDofs p1;
  for (int d = 0; d < 6; ++d) p1.ids[d] = numbers.of_point(0, d);
  p1.position = points[0].position;
  for (const auto& row :
       rigid_dependences(numbers, NodeOrPoint::of_point(1), {0, 1, 2, 3, 4, 5}, p1))
    saddle.add(row);
  std::vector<Member> members(3);
  const int32_t n0 = mesh.node_sets.at("n0")[0], n100 = mesh.node_sets.at("n100")[0];
  members[0] = {{numbers.of_point(1, 0), numbers.of_point(1, 1), numbers.of_point(1, 2), -1,
                 numbers.of_point(1, 4), -1},
                points[1].position,
                2.0};
  members[1] = {{3 * n0, 3 * n0 + 1, 3 * n0 + 2, -1, -1, -1}, mesh.nodes.row(n0).transpose(), 1.0};
  members[2] = {
      {3 * n100, 3 * n100 + 1, 3 * n100 + 2, -1, -1, -1}, mesh.nodes.row(n100).transpose(), 0.5};
  couple(members, 2, {0, 2, 4});
  const int32_t n50 = mesh.node_sets.at("n50")[0];
  saddle.add(
      Functional{{3 * n50, numbers.of_point(2, 0), numbers.of_point(2, 4)}, {2.0, -1.0, 0.1}});

  Eigen::VectorXd f = some_forces(saddle.size());
  for (const int d : {1, 3, 5}) f(numbers.of_point(2, d)) = 0.0;  // unattached DoFs carry no load
  const Eigen::VectorXd want = saddle.solve(f);
  const Eigen::VectorXd got = solve_model(model, f);
  EXPECT_LT((got - want).norm(), kSolve * want.norm());
}

TEST(DistributingCoupling, OnABoundFaceDependsOnWhatBindsIt) {
  // The entire face follows hub rigidly, so that p, which is coupled to the face, follows hub too.
  const mesh::Mesh mesh = bar();
  const fe::FeModel model = build(mesh, std::string(kFoot) + R"(
[[point]]
name = "hub"
at = [0.0, 0.0, 0.3]
[[point]]
name = "p"
at = [0.0, 0.2, 0.3]
[[coupling]]
type = "rigid"
point = "hub"
surface = "z1"
[[coupling]]
point = "p"
surface = "z1"
)")
                                .model;
  EXPECT_FALSE(model.sets.contains("p"));
  const Eigen::VectorXd q = some_forces(model.size());
  const Eigen::VectorXd u = model.points.T * q;
  Eigen::Matrix<double, 6, 6> arm = Eigen::Matrix<double, 6, 6>::Identity();
  arm.topRows<3>() = rigid_motion({0.0, 0.2, 0.3}, {0.0, 0.0, 0.3});
  EXPECT_LT((u.tail(6) - arm * u.head(6)).norm(), 1e-11 * u.norm());
}

TEST(Constraints, ConflictsNameBothSides) {
  const mesh::Mesh mesh = bar();
  const std::string points =
      "[[point]]\nname = \"a\"\nat = [0.0, 0.0, 0.4]\n"
      "[[point]]\nname = \"b\"\nat = [0.1, 0.0, 0.4]\n";
  const auto rigid = [](const std::string& name, const std::string& rest) {
    return "[[coupling]]\nname = \"" + name + "\"\ntype = \"rigid\"\n" + rest;
  };
  // Two rigid couplings share an edge.
  expect_parts(constraint_refusal(
                   mesh, rigid("one", "surface = \"z1\"\n") + rigid("two", "surface = \"x0\"\n")),
               {"test.fe.toml:10: coupling two: found node", "makes dependent and which",
                "test.fe.toml:6: coupling one"});
  // A follower that is supported.
  expect_parts(constraint_refusal(mesh, std::string(kFoot) + rigid("one", "node_set = \"z0\"\n")),
               {"coupling one", "support foot holds"});
  // A sensor among the followers.
  expect_parts(
      constraint_refusal(mesh, rigid("one", "surface = \"z1\"\n") +
                                   "[[sensor]]\nname = \"s\"\nsurface = \"z1\"\nnear = [0.0, 0.0, "
                                   "0.3]\n"),
      {"coupling one", "sensor s keeps"});
  // A dependent point that another coupling moves.
  expect_parts(constraint_refusal(
                   mesh, points + rigid("one", "point = \"a\"\npoints = [\"b\"]\n") +
                             "[[coupling]]\nname = \"ride\"\npoint = \"b\"\nsurface = \"z1\"\n"),
               {"coupling ride", "point b x", "coupling one"});
  // A dependent point that is held.
  expect_parts(constraint_refusal(mesh, points + rigid("one", "point = \"a\"\npoints = [\"b\"]\n") +
                                            rigid("two", "point = \"a\"\nsurface = \"z1\"\n") +
                                            "[[support]]\npoint = \"b\"\ndirections = [\"rz\"]\n"),
               {"coupling one", "point b rz", "support support_1"});
}

TEST(Constraints, SensorFartherFromItsSurfaceThanAnElementIsRefusedWithItsUnit) {
  expect_parts(constraint_refusal(bar(),
                                  "[[sensor]]\nname = \"s\"\nsurface = \"z1\"\nnear = [0.0, "
                                  "0.0, 300.0]\n"),
               {"near: the nearest node lies at (0, 0, 0.3) m",
                "expected at most an element's size", "this one fits in millimetres"});
}

TEST(Constraints, CyclesAreToldAllTheWayRound) {
  const mesh::Mesh mesh = bar();
  const std::string points =
      "[[point]]\nname = \"a\"\nat = [0.0, 0.0, 0.4]\n"
      "[[point]]\nname = \"b\"\nat = [0.1, 0.0, 0.4]\n";
  expect_parts(constraint_refusal(mesh, points + R"(
[[coupling]]
name = "ab"
type = "rigid"
point = "a"
points = ["b"]
[[coupling]]
name = "ba"
point = "a"
[[coupling.term]]
points = ["b"]
[[coupling.term]]
surface = "z1"
)"),
               {"cycle", "point a x", "point b x", "coupling ab", "coupling ba"});
  expect_parts(constraint_refusal(mesh, R"(
[[equation]]
terms = [ { node_set = "n0", direction = "x", coefficient = 1.0 },
          { node_set = "n50", direction = "x", coefficient = 1.0 } ]
[[equation]]
terms = [ { node_set = "n50", direction = "x", coefficient = 1.0 },
          { node_set = "n0", direction = "x", coefficient = 1.0 } ]
)"),
               {"cycle", "equation 1", "equation 2"});
}

}  // namespace
}  // namespace clatter::assembly::testing
