// SPDX-License-Identifier: GPL-3.0-or-later
// Unattached points, supports in any directions, equations that constrain a rigid motion.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "assembly/coupling/dof_numbers.hpp"
#include "bar_model.hpp"
#include "core/dense/cholesky.hpp"
#include "core/fe/axes.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

using test::expect_parts;

std::string support_refusal(const mesh::Mesh& mesh, const std::string& toml) {
  return test::refusal_of([&] { build(mesh, toml); });
}

TEST(Points, LooseDirectionsAreLeftOutAndWhollyLoosePointsRefused) {
  const mesh::Mesh mesh = bar();
  const std::string point = "[[point]]\nname = \"a\"\nat = [0.05, 0.05, 0.3]\n";
  const fe::FeModel model = build(mesh, point + R"(
[[coupling]]
point = "a"
surface = "z1"
directions = "xyz"
)")
                                .model;
  EXPECT_EQ(model.set("a").dofs.size(), 3u);
  EXPECT_EQ(full(model.K).rows(), 3 * mesh.nodes.rows());
  expect_parts(support_refusal(mesh, point), {"point a", "nothing attached"});
  const std::string loaded = point +
                             "[[coupling]]\npoint = \"a\"\nsurface = \"z1\"\ndirections = "
                             "\"xyz\"\n[[point_mass]]\non = \"a\"\nmass = 1.0\n";
  EXPECT_EQ(support_refusal(mesh, loaded), "accepted");
  expect_parts(support_refusal(mesh, loaded + "inertia = [1.0, 1.0, 1.0]\n"),
               {"point a", "mass on rx", "nothing attached"});
  expect_parts(
      support_refusal(mesh, point + "[[coupling]]\npoint = \"a\"\nsurface = \"z1\"\ndirections = "
                                    "\"xyz\"\n[[load]]\nname = \"m\"\nkind = \"force\"\nset = "
                                    "\"a\"\nmoment = [1.0, 0.0, 0.0]\n"),
      {"load m", "nothing attached"});
}

TEST(Points, ASingleFollowerDoesNotHoldItsReferencesRotation) {
  // Rotation about the line from the point to its one follower moves nothing.
  expect_parts(support_refusal(bar(),
                               "[[point]]\nname = \"a\"\nat = [0.0, 0.1, 0.45]\n[[coupling]]\ntype "
                               "= \"rigid\"\npoint = \"a\"\nnode_set = \"n0\"\n"),
               {"motion of a that moves nothing"});
}

constexpr const char* kLinkFromAToB = R"(
[[point]]
name = "on_a"
node_set = "a"
[[coupling]]
type = "rigid"
point = "on_a"
node_set = "b"
)";

// Both nodes turn freely, so that a rigid link between them is a rod: (u_b - u_a) . r = 0.
TEST(Points, ALinkOfTwoNodesIsARodInAnyDirection) {
  mesh::Mesh mesh = bar();
  mesh.node_sets["a"] = mesh.node_sets.at("n0");
  for (const int32_t node : mesh.node_sets.at("z1"))
    if (mesh.nodes(node, 0) > 0.09 && mesh.nodes(node, 1) > 0.09) mesh.node_sets["b"] = {node};
  const Eigen::RowVector3d r =
      mesh.nodes.row(mesh.node_sets["b"][0]) - mesh.nodes.row(mesh.node_sets["a"][0]);
  ASSERT_TRUE((r.array().abs() > 1e-3).all());  // skew
  const BuiltModel link = build(mesh, std::string(kFoot) + kLinkFromAToB);
  std::string rod = std::string(kFoot) + "[[equation]]\nterms = [\n";
  for (int d = 0; d < 3; ++d)
    for (const auto& [set, sign] : {std::pair("b", 1.0), std::pair("a", -1.0)})
      rod += fmt::format("{{ node_set = \"{}\", direction = \"{}\", coefficient = {} }},\n", set,
                         "xyz"[d], sign * r(d));
  const BuiltModel equation = build(mesh, rod + "]\n");
  EXPECT_EQ(link.model.size(), equation.model.size());
  const Eigen::Index nodal = 3 * mesh.nodes.rows();
  Eigen::VectorXd f = some_forces(nodal + 6);
  f.tail<6>().setZero();
  const Eigen::VectorXd u = solve_model(link.model, f).head(nodal);
  const Eigen::VectorXd want = solve_model(equation.model, f.head(nodal));
  EXPECT_LT((u - want).norm(), kSolve * want.norm());
  // About its line it has no inertia: a mass that turns there needs more.
  expect_parts(support_refusal(mesh, std::string(kFoot) + kLinkFromAToB + R"(
[[point_mass]]
on = "on_a"
mass = 1.0
inertia = [1.0, 1.0, 1.0]
)"),
               {"point on_a", "mass on rotation about", "nothing attached"});
}

TEST(Nodes, KeepSomeDirectionsOfNodesAndPoints) {
  const fe::FeModel model = build(bar(), R"(
[[point]]
name = "hub"
at = [0.05, 0.05, 0.4]
[[coupling]]
point = "hub"
surface = "z1"
[[nodes]]
name = "retained"
[[nodes.term]]
node_set = "n0"
directions = "xz"
[[nodes.term]]
points = ["hub"]
directions = ["y", "rz"]
)")
                                .model;
  const rom::DofSet& set = model.set("retained");
  EXPECT_EQ(set.labels, (std::vector<std::string>{"retained[0].x", "retained[0].z", "retained[1].y",
                                                  "retained[1].rz"}));
  EXPECT_EQ(set.dofs[2], model.set("hub").dofs[1]);
  EXPECT_EQ(set.dofs[3], model.set("hub").dofs[5]);
  EXPECT_EQ(set.is_rotation.back(), 1);
  expect_parts(support_refusal(bar(),
                               "[[nodes]]\nname = \"n\"\n[[nodes.term]]\nnode_set = "
                               "\"n0\"\ndirections = \"xy\"\n[[point_mass]]\non = "
                               "\"n\"\nmass = 1.0\n"),
               {"point_mass on n", "found 2 directions"});
}

constexpr const char* kTurned =
    "[system.skew]\norigin = [0.01, 0.02, 0.03]\nz = [1.0, 2.0, 2.0]\nx = [2.0, 1.0, -2.0]\n";

TEST(Nodes, AreKeptAlongTheAxesOfASystem) {
  const mesh::Mesh mesh = bar();
  const std::string point =
      std::string(kFoot) + kTurned +
      "[[point]]\nname = \"hub\"\nat = [0.05, 0.05, 0.4]\n[[coupling]]\ntype = \"rigid\"\npoint = "
      "\"hub\"\nsurface = \"z1\"\n";
  const std::string kept = point + R"(
[[nodes]]
name = "retained"
[[nodes.term]]
node_set = "n0"
directions = "xz"
system = "skew"
[[nodes.term]]
points = ["hub"]
directions = ["x", "y", "z", "rx", "ry", "rz"]
system = "skew"
)";
  const fe::FeModel plain = build(mesh, point).model, model = build(mesh, kept).model;
  ASSERT_EQ(model.size(), plain.size());
  // The same body: the same displacements under the same forces.
  const Eigen::VectorXd f = some_forces(3 * mesh.nodes.rows() + 6);
  const Eigen::VectorXd u = solve_model(model, f), want = solve_model(plain, f);
  EXPECT_LT((u - want).norm(), kSolve * want.norm());
  // q = D u, in the model's coordinates and of its rigid motions.
  const rom::DofSet& set = model.set("retained");
  EXPECT_EQ(set.components, (std::vector<int32_t>{1, 3, 1, 2, 3, 4, 5, 6}));
  const Eigen::MatrixXd T = model.T;
  const Eigen::Index node = 3 * mesh.node_sets.at("n0")[0];
  Eigen::Matrix3d frame;
  frame << 2, -2, 1, 1, 2, 2, -2, -1, 2;
  frame /= 3.0;
  EXPECT_EQ(set.direction.row(0).transpose(), set.direction.row(2).transpose());
  for (const auto& [k, axis] : {std::pair(0, 0), std::pair(1, 2)}) {
    EXPECT_LT((set.direction.row(k).transpose() - frame.col(axis)).norm(), 1e-15);
    // u of the node follows from its three coordinates; along the kept axes by these alone.
    const Eigen::RowVectorXd row = frame.col(axis).transpose() * T.middleRows(node, 3);
    Eigen::RowVectorXd unit = Eigen::RowVectorXd::Zero(model.size());
    unit(set.dofs[k]) = 1.0;
    EXPECT_LT((row - unit).norm(), 1e-14);
  }
  const Eigen::MatrixXd hub = model.points.T;
  for (int d = 0; d < 6; ++d)
    EXPECT_LT((frame.col(d % 3).transpose() * hub.middleRows(d < 3 ? 0 : 3, 3) -
               Eigen::RowVectorXd::Unit(model.size(), set.dofs[2 + d]))
                  .norm(),
              1e-14);
}

TEST(Nodes, KeptAlongTwoKindsOfAxesAreRefused) {
  const std::string turned =
      std::string(kTurned) + "[[nodes]]\nname = \"a\"\nnode_set = \"n0\"\nsystem = \"skew\"\n";
  expect_parts(support_refusal(bar(), turned + "[[nodes]]\nname = \"b\"\nnode_set = \"n0\"\n"),
               {"nodes b", "is kept along x y z and along the axes of a system"});
  // A support along one of these axes leaves the others.
  const std::string held = std::string(kFoot) + kTurned +
                           "[[support]]\nnode_set = \"n0\"\ndirections = \"y\"\nsystem = \"skew\"\n"
                           "[[nodes]]\nname = \"a\"\n[[nodes.term]]\nnode_set = \"n0\"\nsystem = "
                           "\"skew\"\ndirections = ";
  EXPECT_EQ(build(bar(), held + "\"xz\"\n").model.set("a").dofs.size(), 2u);
  expect_parts(
      support_refusal(bar(), held + "\"xyz\"\n"),
      {"nodes a", "found rows that supports, sensors or other couplings already determine"});
}

TEST(Points, OnAMeshNodeMoveWithIt) {
  const mesh::Mesh mesh = bar();
  const fe::FeModel model = build(mesh, R"(
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
  fe::Axes axes;
  axes.kind = fe::Axes::Kind::kCylindrical;
  axes.origin = {1.0, 0.0, 0.0};
  const Eigen::Matrix3d c = axes.at({1.0, 2.0, 5.0});
  EXPECT_LT((c.col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((c.col(1) + Eigen::Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((c.col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  axes.kind = fe::Axes::Kind::kSpherical;
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
  const fe::FeModel& model = built.model;
  EXPECT_LT(built.certificate.rigid_force_residue.value(), 1e-10);
  Saddle saddle(mesh, 0);
  const std::vector<int32_t> foot = mesh::nodes_of(mesh.surface("z0"));
  for (const int32_t node : foot) saddle.add(Functional{{3 * node + 2}, {1.0}});
  const std::vector<int32_t> bore = mesh::nodes_of(mesh.surface("y0"));
  for (const int32_t node : bore) {
    const Eigen::Vector2d r = mesh.nodes.row(node).head<2>().transpose().normalized();
    saddle.add(Functional{{3 * node, 3 * node + 1}, {r.x(), r.y()}});
  }
  ASSERT_EQ(model.supports.size(), static_cast<int>(foot.size() + bore.size()));
  // Rotation about z is free: remove its part from the load and from both solutions.
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
  Eigen::VectorXd got = model.T * dense::Cholesky(K).solve(model.T.transpose() * f);
  got -= turn.dot(got) * turn;
  want -= turn.dot(want) * turn;
  EXPECT_LT((got - want).norm(), kSolve * want.norm());
}

// A direction of a system that points against a basic axis is that direction, not the axis.
TEST(Supports, InATurnedSystemMoveAlongItsDirections) {
  const mesh::Mesh mesh = bar();
  const fe::FeModel model = build(mesh, R"(
[system.turned]
x = [-1.0, 0.0, 0.0]
z = [0.0, 0.0, 1.0]
[[support]]
name = "foot"
surface = "z0"
system = "turned"
[[load]]
name = "shift"
kind = "displacement"
surface = "z0"
system = "turned"
directions = "x"
value = 0.25e-3
)")
                                .model;
  const Eigen::VectorXd u = model.supports.T * model.prescribed.at("shift");
  for (const int32_t node : mesh::nodes_of(mesh.surface("z0"))) {
    EXPECT_NEAR(u(3 * node), -0.25e-3, 1e-12);
    EXPECT_EQ(u(3 * node + 1), 0.0);
  }
}

TEST(Supports, HoldingADirectionTwiceIsHoldingIt) {
  const mesh::Mesh mesh = bar();
  const fe::FeModel twice =
      build(mesh, std::string(kFoot) + "[[support]]\nnode_set = \"z0\"\n").model;
  const fe::FeModel once = build(mesh, kFoot).model;
  EXPECT_EQ((twice.K - once.K).norm(), 0.0);
  EXPECT_EQ(twice.supports.size(), once.supports.size());
}

TEST(Equations, ThatHoldARigidMotionAreLeftOutOfItsProof) {
  // x of two nodes sums to zero: x itself is held, rotations about the midpoint are not.
  const BuiltModel built = build(bar(), R"(
[[equation]]
terms = [ { node_set = "n0", direction = "x", coefficient = 1.0 },
          { node_set = "n100", direction = "x", coefficient = 1.0 } ]
)");
  EXPECT_EQ(built.certificate.rigid_motions_held_by_equations.value(), 1.0);
  EXPECT_LT(built.certificate.rigid_force_residue.value(), 1e-10);
}

}  // namespace
}  // namespace clatter::assembly::testing
