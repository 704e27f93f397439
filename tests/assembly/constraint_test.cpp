// Points, rigid and distributing couplings, equations and supports against Lagrange multipliers.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <random>

#include "assembly/axes.hpp"
#include "assembly/dof_numbers.hpp"
#include "assembly/member_group.hpp"
#include "assembly/rigid_coupling.hpp"
#include "block_mesh.hpp"
#include "core/error.hpp"
#include "saddle.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

/// A bar of 0.1 x 0.1 x 0.3 m with node sets for its ends and a few single nodes.
mesh::Mesh bar() {
  mesh::Mesh mesh = block_mesh({1, 1, 3}, brick({0.1, 0.1, 0.3}));
  for (const char* side : {"z0", "z1", "x0", "y1"})
    mesh.node_sets[side] = mesh::nodes_of(mesh.surface(side));
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    if (std::abs(mesh.nodes(a, 2) - 0.2) < 1e-12 && mesh.nodes(a, 1) < 1e-12)
      mesh.node_sets["n" + std::to_string(std::lround(1e3 * mesh.nodes(a, 0)))] = {
          static_cast<int32_t>(a)};
  return mesh;
}

constexpr const char* kFoot = "[[support]]\nname = \"foot\"\nsurface = \"z0\"\n";

void hold_foot(const mesh::Mesh& mesh, Saddle& saddle) {
  for (const int32_t node : mesh.node_sets.at("z0"))
    for (int d = 0; d < 3; ++d) saddle.add(Functional{{3 * node + d}, {1.0}});
}

/// Solves the model for forces on all DoFs (nodes, then points); u of all DoFs.
Eigen::VectorXd solve_model(const FeModel& model, const Eigen::VectorXd& f) {
  const Eigen::Index nodal = model.T.rows(), n = model.size();
  Eigen::MatrixXd T(f.size(), n);
  T.topRows(nodal) = model.T;
  if (f.size() > nodal) T.bottomRows(f.size() - nodal) = model.points.T;
  const Eigen::LLT<Eigen::MatrixXd> factor(full(model.K));
  EXPECT_EQ(factor.info(), Eigen::Success);
  EXPECT_EQ(full(model.M).llt().info(), Eigen::Success);
  return T * factor.solve(T.transpose() * f);
}

Eigen::VectorXd some_forces(Eigen::Index size) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal(0.0, 100.0);
  return Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return normal(generator); });
}

/// Rounding of a stiffness of condition 1e6, and of the oracle's pseudo-inverse.
constexpr double kSolve = 1e-8;

std::string refusal(const mesh::Mesh& mesh, const std::string& toml) {
  try {
    build(mesh, toml);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << "one line: " << text;
}

TEST(RigidCoupling, FollowsItsReferenceLikeALever) {
  const std::vector<ReferencePoint> points = {{"p", {1.0, 0.0, 0.0}, -1}};
  const RowMatrix nodes = (RowMatrix(1, 3) << 1.0, 2.0, 0.0).finished();
  const DofNumbers numbers(nodes, points);
  ReferenceDofs reference;
  for (int d = 0; d < 6; ++d) reference.ids[static_cast<size_t>(d)] = numbers.of_point(0, d);
  reference.place = points[0].place;
  const auto rows = rigid_dependences(numbers, DofPlace::of_node(0), {0, 1, 2, 3}, reference);
  ASSERT_EQ(rows.size(), 3u);  // a node has no rotation
  // r = (0, 2, 0): u_x = p_x - 2 rz, u_y = p_y, u_z = p_z + 2 rx.
  EXPECT_EQ(rows[0].on.dofs, (std::vector<int32_t>{3, 8}));
  EXPECT_EQ(rows[0].on.values, (std::vector<double>{1.0, -2.0}));
  EXPECT_EQ(rows[1].on.dofs, (std::vector<int32_t>{4}));
  EXPECT_EQ(rows[2].on.values, (std::vector<double>{1.0, 2.0}));
}

TEST(RigidCoupling, WithItsOwnReferenceNodeEqualsTheMultipliers) {
  const mesh::Mesh mesh = bar();
  const FeModel model = build(mesh, std::string(kFoot) + R"(
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
  for (int d = 0; d < 6; ++d) reference.ids[static_cast<size_t>(d)] = numbers.of_point(0, d);
  reference.place = points[0].place;
  Saddle saddle(mesh, 1);
  hold_foot(mesh, saddle);
  for (const int32_t node : mesh.node_sets.at("z1"))
    for (const auto& row :
         rigid_dependences(numbers, DofPlace::of_node(node), {0, 1, 2}, reference))
      saddle.add(row);
  Eigen::VectorXd f = some_forces(saddle.size());
  const Eigen::VectorXd want = saddle.solve(f);
  // The reference is a set here and no point: its forces act on the set's coordinates.
  Eigen::VectorXd q_forces = model.T.transpose() * f.head(numbers.nodal());
  for (int d = 0; d < 6; ++d)
    q_forces(model.set("hub").dofs[static_cast<size_t>(d)]) += f(numbers.nodal() + d);
  const Eigen::VectorXd q = full(model.K).llt().solve(q_forces);
  EXPECT_LT((model.T * q - want.head(numbers.nodal())).norm(), kSolve * want.norm());
  for (int d = 0; d < 6; ++d)
    EXPECT_NEAR(q(model.set("hub").dofs[static_cast<size_t>(d)]), want(numbers.nodal() + d),
                kSolve * want.norm());
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
  EXPECT_THROW(distribute(members, {0.0, 0.0, 0.0}, {3}, "test"), InputError);
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

/// A chain: p1 rides on the end face, p2 and the row x0 ... follows p1 rigidly, p3 rides on p2 and
/// two nodes, and an equation binds node n50 to p3.
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
  const FeModel model = build(mesh, toml).model;

  const std::vector<ReferencePoint> points = {
      {"p1", {0.05, 0.05, 0.4}, -1}, {"p2", {0.2, 0.05, 0.4}, -1}, {"p3", {0.1, 0.0, 0.25}, -1}};
  const DofNumbers numbers(mesh.nodes, points);
  Saddle saddle(mesh, 3);
  hold_foot(mesh, saddle);
  const auto ride = [&](const std::vector<Member>& members, int32_t point,
                        const std::vector<int>& directions) {
    const Coupling coupling =
        distribute(members, points[static_cast<size_t>(point)].place, directions, "test");
    const std::vector<Functional> rows = coupling.nodal_rows();
    for (size_t k = 0; k < rows.size(); ++k)
      saddle.add(Dependence{numbers.of_point(point, directions[k]), rows[k]});
  };
  ride(members_of(mesh.nodes, integrate_surface(mesh.nodes, mesh.surface("z1"))), 0,
       {0, 1, 2, 3, 4, 5});
  ReferenceDofs p1;
  for (int d = 0; d < 6; ++d) p1.ids[static_cast<size_t>(d)] = numbers.of_point(0, d);
  p1.place = points[0].place;
  for (const auto& row : rigid_dependences(numbers, DofPlace::of_point(1), {0, 1, 2, 3, 4, 5}, p1))
    saddle.add(row);
  std::vector<Member> members(3);
  const int32_t n0 = mesh.node_sets.at("n0")[0], n100 = mesh.node_sets.at("n100")[0];
  members[0] = {{numbers.of_point(1, 0), numbers.of_point(1, 1), numbers.of_point(1, 2), -1,
                 numbers.of_point(1, 4), -1},
                points[1].place,
                2.0};
  members[1] = {{3 * n0, 3 * n0 + 1, 3 * n0 + 2, -1, -1, -1}, mesh.nodes.row(n0).transpose(), 1.0};
  members[2] = {
      {3 * n100, 3 * n100 + 1, 3 * n100 + 2, -1, -1, -1}, mesh.nodes.row(n100).transpose(), 0.5};
  ride(members, 2, {0, 2, 4});
  const int32_t n50 = mesh.node_sets.at("n50")[0];
  saddle.add(
      Functional{{3 * n50, numbers.of_point(2, 0), numbers.of_point(2, 4)}, {2.0, -1.0, 0.1}});

  Eigen::VectorXd f = some_forces(saddle.size());
  for (const int d : {1, 3, 5}) f(numbers.of_point(2, d)) = 0.0;  // loose DoFs take no load
  const Eigen::VectorXd want = saddle.solve(f);
  const Eigen::VectorXd got = solve_model(model, f);
  EXPECT_LT((got - want).norm(), kSolve * want.norm());
}

TEST(DistributingCoupling, OnABoundFaceDependsOnWhatBindsIt) {
  // All of the face follows hub rigidly, so that p, which rides on the face, follows hub too.
  const mesh::Mesh mesh = bar();
  const FeModel model = build(mesh, std::string(kFoot) + R"(
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
  expect_parts(
      refusal(mesh, rigid("one", "surface = \"z1\"\n") + rigid("two", "surface = \"x0\"\n")),
      {"test.fe.toml:10: coupling two: found node", "makes dependent and which",
       "test.fe.toml:6: coupling one"});
  // A follower that is supported.
  expect_parts(refusal(mesh, std::string(kFoot) + rigid("one", "node_set = \"z0\"\n")),
               {"coupling one", "support foot holds"});
  // A sensor among the followers.
  expect_parts(refusal(mesh, rigid("one", "surface = \"z1\"\n") +
                                 "[[sensor]]\nname = \"s\"\nsurface = \"z1\"\nnear = [0.0, 0.0, "
                                 "0.3]\n"),
               {"coupling one", "sensor s keeps"});
  // A dependent point that another coupling moves.
  expect_parts(
      refusal(mesh, points + rigid("one", "point = \"a\"\npoints = [\"b\"]\n") +
                        "[[coupling]]\nname = \"ride\"\npoint = \"b\"\nsurface = \"z1\"\n"),
      {"coupling ride", "point b x", "coupling one"});
  // A dependent point that is held.
  expect_parts(refusal(mesh, points + rigid("one", "point = \"a\"\npoints = [\"b\"]\n") +
                                 rigid("two", "point = \"a\"\nsurface = \"z1\"\n") +
                                 "[[support]]\npoint = \"b\"\ndirections = [\"rz\"]\n"),
               {"coupling one", "point b rz", "support support_1"});
}

TEST(Constraints, CyclesAreToldAllTheWayRound) {
  const mesh::Mesh mesh = bar();
  const std::string points =
      "[[point]]\nname = \"a\"\nat = [0.0, 0.0, 0.4]\n"
      "[[point]]\nname = \"b\"\nat = [0.1, 0.0, 0.4]\n";
  expect_parts(refusal(mesh, points + R"(
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
  expect_parts(refusal(mesh, R"(
[[equation]]
terms = [ { node_set = "n0", direction = "x", coefficient = 1.0 },
          { node_set = "n50", direction = "x", coefficient = 1.0 } ]
[[equation]]
terms = [ { node_set = "n50", direction = "x", coefficient = 1.0 },
          { node_set = "n0", direction = "x", coefficient = 1.0 } ]
)"),
               {"cycle", "equation 1", "equation 2"});
}

TEST(Points, LooseDirectionsAreLeftOutAndWhollyLoosePointsRefused) {
  const mesh::Mesh mesh = bar();
  const std::string point = "[[point]]\nname = \"a\"\nat = [0.05, 0.05, 0.3]\n";
  const FeModel model = build(mesh, point + R"(
[[coupling]]
point = "a"
surface = "z1"
directions = "xyz"
)")
                            .model;
  EXPECT_EQ(model.set("a").dofs.size(), 3u);
  EXPECT_EQ(full(model.K).rows(), 3 * mesh.nodes.rows());
  expect_parts(refusal(mesh, point), {"point a", "nothing attached"});
  const std::string loaded = point +
                             "[[coupling]]\npoint = \"a\"\nsurface = \"z1\"\ndirections = "
                             "\"xyz\"\n[[point_mass]]\non = \"a\"\nmass = 1.0\n";
  EXPECT_EQ(refusal(mesh, loaded), "accepted");
  expect_parts(refusal(mesh, loaded + "inertia = [1.0, 1.0, 1.0]\n"),
               {"point a", "mass on rx", "nothing holds"});
  expect_parts(refusal(mesh, point + "[[coupling]]\npoint = \"a\"\nsurface = \"z1\"\ndirections = "
                                     "\"xyz\"\n[[load]]\nname = \"m\"\nkind = \"force\"\nset = "
                                     "\"a\"\nmoment = [1.0, 0.0, 0.0]\n"),
               {"load m", "nothing is attached"});
}

TEST(Points, ASingleFollowerDoesNotHoldItsReferencesRotation) {
  // Rotation about the line from the point to its one follower moves nothing.
  expect_parts(refusal(bar(),
                       "[[point]]\nname = \"a\"\nat = [0.0, 0.1, 0.45]\n[[coupling]]\ntype "
                       "= \"rigid\"\npoint = \"a\"\nnode_set = \"n0\"\n"),
               {"motion of a that moves nothing"});
}

TEST(Points, OnAMeshNodeMoveWithIt) {
  const mesh::Mesh mesh = bar();
  const FeModel model = build(mesh, R"(
[[point]]
name = "a"
node_set = "n0"
[[coupling]]
type = "rigid"
point = "a"
node_set = "z1"
)")
                            .model;
  const Eigen::VectorXd q = some_forces(model.size());
  const Eigen::VectorXd u = model.T * q, p = model.points.T * q;
  const int32_t node = mesh.node_sets.at("n0")[0];
  EXPECT_EQ((u.segment<3>(3 * node) - p.head<3>()).norm(), 0.0);
  const int32_t follower = mesh.node_sets.at("z1")[2];
  const Eigen::Vector3d want =
      rigid_motion(mesh.nodes.row(follower).transpose(), mesh.nodes.row(node).transpose()) * p;
  EXPECT_LT((u.segment<3>(3 * follower) - want).norm(), 1e-12 * want.norm());
}

TEST(Axes, CylindricalAndSphericalDirectionsByHand) {
  Axes axes;
  axes.kind = Axes::Kind::kCylindrical;
  axes.origin = {1.0, 0.0, 0.0};
  const Eigen::Matrix3d c = axes.at({1.0, 2.0, 5.0});
  EXPECT_LT((c.col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((c.col(1) + Eigen::Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((c.col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  axes.kind = Axes::Kind::kSpherical;
  const Eigen::Matrix3d s = axes.at({4.0, 0.0, 4.0});  // 3 along x, 4 along z
  EXPECT_LT((s.col(0) - Eigen::Vector3d(0.6, 0.0, 0.8)).norm(), 1e-15);
  EXPECT_LT((s.col(1) - Eigen::Vector3d(0.8, 0.0, -0.6)).norm(), 1e-15);
  EXPECT_LT((s.col(2) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_NEAR(s.determinant(), 1.0, 1e-15);
}

TEST(Supports, InACylindricalSystemHoldTheRadialDirectionOnly) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  const mesh::Mesh mesh = block_mesh({6, 1, 1}, ring(0.04, 0.06, 0.05), options);
  const BuiltModel built = build(mesh, R"(
[system.axis]
kind = "cylindrical"
[[support]]
name = "bore"
surface = "y0"
directions = "x"
system = "axis"
[[support]]
name = "foot"
surface = "z0"
directions = "z"
)");
  const FeModel& model = built.model;
  EXPECT_LT(built.certificate.at("rigid_force_residue"), 1e-10);
  Saddle saddle(mesh, 0);
  const std::vector<int32_t> foot = mesh::nodes_of(mesh.surface("z0"));
  for (const int32_t node : foot) saddle.add(Functional{{3 * node + 2}, {1.0}});
  const std::vector<int32_t> bore = mesh::nodes_of(mesh.surface("y0"));
  for (const int32_t node : bore) {
    const Eigen::Vector2d r = mesh.nodes.row(node).head<2>().transpose().normalized();
    saddle.add(Functional{{3 * node, 3 * node + 1}, {r.x(), r.y()}});
  }
  ASSERT_EQ(model.supports.size(), static_cast<int>(foot.size() + bore.size()));
  // A turn about z is free: take its part out of the load, and out of both answers.
  Eigen::VectorXd turn(3 * mesh.nodes.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    turn.segment<3>(3 * a) << -mesh.nodes(a, 1), mesh.nodes(a, 0), 0.0;
  turn.normalize();
  Eigen::VectorXd f = some_forces(turn.size());
  f -= turn.dot(f) * turn;
  Eigen::VectorXd want = saddle.solve(f);
  Eigen::MatrixXd K = full(model.K);
  const Eigen::VectorXd free = model.rigid.col(5);
  K += K.diagonal().mean() / free.squaredNorm() * free * free.transpose();
  Eigen::VectorXd got = model.T * K.llt().solve(model.T.transpose() * f);
  got -= turn.dot(got) * turn;
  want -= turn.dot(want) * turn;
  EXPECT_LT((got - want).norm(), kSolve * want.norm());
}

TEST(Supports, HoldingADirectionTwiceIsHoldingIt) {
  const mesh::Mesh mesh = bar();
  const FeModel twice = build(mesh, std::string(kFoot) + "[[support]]\nnode_set = \"z0\"\n").model;
  const FeModel once = build(mesh, kFoot).model;
  EXPECT_EQ((twice.K - once.K).norm(), 0.0);
  EXPECT_EQ(twice.supports.size(), once.supports.size());
}

TEST(Equations, ThatHoldARigidMotionAreLeftOutOfItsProof) {
  // x of two nodes sums to zero: x itself is held, turns about the middle are not.
  const BuiltModel built = build(bar(), R"(
[[equation]]
terms = [ { node_set = "n0", direction = "x", coefficient = 1.0 },
          { node_set = "n100", direction = "x", coefficient = 1.0 } ]
)");
  EXPECT_EQ(built.certificate.at("rigid_motions_held_by_equations"), 1.0);
  EXPECT_LT(built.certificate.at("rigid_force_residue"), 1e-10);
}

}  // namespace
}  // namespace clatter::assembly::testing
