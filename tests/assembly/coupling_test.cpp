// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/coupling.hpp"

#include <gtest/gtest.h>

#include "assembly/constraint/elimination.hpp"
#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/dense/cholesky.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/fe/assemble.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

Eigen::MatrixXd dense_rows(const Coupling& coupling, Eigen::Index n_dofs) {
  const std::vector<Functional> rows = coupling.nodal_rows();
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), n_dofs);
  for (size_t r = 0; r < rows.size(); ++r)
    for (size_t k = 0; k < rows[r].dofs.size(); ++k)
      C(static_cast<Eigen::Index>(r), rows[r].dofs[k]) = rows[r].values[k];
  return C;
}

Eigen::MatrixXd rigid_of(const RowMatrix& nodes, const Eigen::Vector3d& point) {
  Eigen::MatrixXd rigid(3 * nodes.rows(), 6);
  for (Eigen::Index a = 0; a < nodes.rows(); ++a)
    rigid.middleRows<3>(3 * a) = rigid_motion(nodes.row(a).transpose(), point);
  return rigid;
}

/// Two linear triangles make the square (0,0)-(2,2) in the plane z = 0.
struct Square {
  RowMatrix nodes = (RowMatrix(4, 3) << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0).finished();
  mesh::Surface triangles{
      {{mesh::FaceType::kTri3, (IndexMatrix(2, 3) << 0, 1, 2, 0, 2, 3).finished()}}};
};

TEST(SurfaceIntegrals, OfASquareByHand) {
  const Square square;
  const SurfaceIntegrals s = integrate_surface(square.nodes, square.triangles);
  EXPECT_NEAR(s.area, 4.0, 1e-14);
  EXPECT_LT((s.centroid - Eigen::Vector3d(1, 1, 0)).norm(), 1e-14);
  // Each triangle (area 2) gives a third of its area to each corner; nodes 0 and 2 are in both.
  EXPECT_LT((s.weight - Eigen::Vector4d(4, 2, 4, 2) / 3.0).norm(), 1e-14);
  EXPECT_NEAR(s.normal(0, 2), 4.0 / 3.0, 1e-14);
}

TEST(SurfaceIntegrals, CornersOfFlatQuadraticTrianglesGetNoArea) {
  const mesh::Mesh mesh = block_mesh({2, 2, 1}, brick({1, 1, 1}));
  const SurfaceIntegrals s = integrate_surface(mesh.nodes, mesh.surface("z1"));
  EXPECT_NEAR(s.area, 1.0, 1e-14);
  int corners = 0;
  for (const double w : s.weight) corners += std::abs(w) < 1e-15 ? 1 : 0;
  EXPECT_EQ(corners, 9);
}

TEST(DistributingCoupling, OfASquareByHand) {
  // u = (0, 0, x): the plane rotates by -1 about y; the centre (1, 1) moves by 1 along z.
  const Square square;
  const Coupling coupling =
      distributing_coupling("ref", "node", square.nodes,
                            integrate_surface(square.nodes, square.triangles), {}, 6, "test");
  const Eigen::MatrixXd C = dense_rows(coupling, 12);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(12);
  u(5) = u(8) = 2.0;
  const Eigen::VectorXd q = C * u;
  EXPECT_LT((q - (Eigen::VectorXd(6) << 0, 0, 1, 0, -1, 0).finished()).norm(), 1e-14);
  // One corner (node 1) lifted by 1: mean = its area share 2/3 of 4.
  u.setZero();
  u(5) = 1.0;
  EXPECT_NEAR((C * u)(2), 1.0 / 6.0, 1e-14);
  EXPECT_EQ(coupling.set.labels[4], "ref.ry");
  EXPECT_EQ(coupling.set.is_rotation[4], 1);
}

mesh::Mesh ring_mesh(int around, int along) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  return block_mesh({around, 1, along}, ring(0.04, 0.06, 0.1), options);
}

/// A small face, coupled directly, and a large one, coupled in groups.
class DistributingCouplingOn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(RingsOfCells, DistributingCouplingOn, ::testing::Values(6, 14));

TEST_P(DistributingCouplingOn, ReproducesRigidMotionsAndTransposesToResultants) {
  const mesh::Mesh mesh = ring_mesh(GetParam(), GetParam() / 3);
  const Eigen::Vector3d point(0.01, -0.02, 0.2);
  const Coupling coupling =
      distributing_coupling("b", "bearing", mesh.nodes,
                            integrate_surface(mesh.nodes, mesh.surface("y0")), point, 6, "test");
  const Eigen::MatrixXd C = dense_rows(coupling, 3 * mesh.nodes.rows());
  const Eigen::MatrixXd rigid = rigid_of(mesh.nodes, point);
  // q of rigid motions about the point is the unit matrix; by transposition the nodal forces
  // C^T f have the resultant force and moment f about the point.
  EXPECT_LT((C * rigid - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(DistributingCoupling, RefusesALine) {
  Square line;
  line.nodes.col(1) *= 1e-12;
  test::expect_parts(
      test::refusal_of([&] {
        distributing_coupling("l", "node", line.nodes,
                              integrate_surface(line.nodes, line.triangles), {}, 6, "test");
      }),
      {"test: found nodes that do not define rx of the reference", "expected a face with area"});
}

TEST(MeanDisplacement, IsTheAreaWeightedMean) {
  const mesh::Mesh mesh = block_mesh({3, 2, 2}, brick({3, 1, 1}));
  const SurfaceIntegrals s = integrate_surface(mesh.nodes, mesh.surface("z1"));
  const Coupling mean = mean_displacement("m", mesh.nodes, s, Eigen::Vector3d::UnitZ(), {}, "test");
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    u(3 * a + 2) = mesh.nodes(a, 0) * mesh.nodes(a, 0);  // mean of x^2 over 0..3 is 3
  EXPECT_NEAR((dense_rows(mean, u.size()) * u)(0), 3.0, 1e-13);
  test::expect_parts(test::refusal_of([&] {
                       mean_displacement("m", mesh.nodes, s, Eigen::Vector3d::UnitZ(),
                                         std::pair{5.0, 6.0}, "test");
                     }),
                     {"test: found no node of the surface in the range, expected some"});
}

constexpr const char* kTwoCouplings = R"(
[[support]]
surface = "z0"
[[coupling]]
name = "top"
surface = "z1"
dofs = 6
[[coupling]]
name = "bore"
surface = "y0"
dofs = 6
[[mean]]
name = "bore_axial"
surface = "y0"
direction = [0.0, 0.0, 1.0]
range = [0.02, 0.09]
)";

mesh::Mesh small_ring() { return ring_mesh(6, 2); }

TEST_P(DistributingCouplingOn, ASolveInGeneralisedCoordinatesEqualsTheNodalOne) {
  // The oracle: nodal K with the distributed forces C^T f, then q = C u.
  const mesh::Mesh mesh = ring_mesh(GetParam(), GetParam() / 3);
  const BuiltModel built = build(mesh, kTwoCouplings);
  const fe::FeModel& model = built.model;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(model.size());
  std::vector<int32_t> dofs;
  for (const char* name : {"top", "bore", "bore_axial"})
    for (const int32_t dof : model.set(name).dofs) dofs.push_back(dof);
  ASSERT_EQ(dofs.size(), 13u);
  for (size_t k = 0; k < dofs.size(); ++k) f(dofs[k]) = 100.0 + 10.0 * static_cast<double>(k);
  const Eigen::VectorXd q = dense::Cholesky(full(model.K)).solve(f);
  const Eigen::VectorXd u = model.T * q;

  const SurfaceIntegrals bore = integrate_surface(mesh.nodes, mesh.surface("y0"));
  const SurfaceIntegrals top = integrate_surface(mesh.nodes, mesh.surface("z1"));
  const Eigen::Index n = u.size();
  Eigen::MatrixXd C(13, n);
  C << dense_rows(distributing_coupling("a", "node", mesh.nodes, top, {}, 6, ""), n),
      dense_rows(distributing_coupling("b", "node", mesh.nodes, bore, {}, 6, ""), n),
      dense_rows(mean_displacement("c", mesh.nodes, bore, Eigen::Vector3d::UnitZ(),
                                   std::pair{0.02, 0.09}, ""),
                 n);
  const fe::NodalMatrices nodal = fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh));
  std::vector<bool> fixed(static_cast<size_t>(n), false);
  for (const int32_t node : mesh::nodes_of(mesh.surface("z0")))
    for (int d = 0; d < 3; ++d) fixed[3 * node + d] = true;
  Eigen::VectorXd f_c(13);
  for (Eigen::Index k = 0; k < 13; ++k) f_c(k) = f(dofs[k]);
  const Eigen::VectorXd want =
      solve_fixed(nodal.K, C.transpose() * f_c, fixed, Eigen::VectorXd::Zero(n));
  // The condition of K times rounding: 1e6 * 1e-16, with a margin of two digits.
  EXPECT_LT((u - want).norm(), 1e-8 * want.norm());
  Eigen::VectorXd q_c(13);
  for (Eigen::Index k = 0; k < 13; ++k) q_c(k) = q(dofs[k]);
  EXPECT_LT((q_c - C * want).norm(), 1e-8 * q_c.norm());
}

TEST(Elimination, AFreeCoupledModelKeepsSixRigidMotionsAndItsFrequencies) {
  const mesh::Mesh mesh = small_ring();
  std::string free = kTwoCouplings;
  free.erase(0, free.find("[[coupling]]"));
  const fe::FeModel coupled = build(mesh, free).model;
  const fe::FeModel plain = build(mesh, "").model;
  const auto values = [](const fe::FeModel& of) {
    return dense::symmetric_eigen(full(of.K), full(of.M), dense::EigenParts::kValues).values;
  };
  const Eigen::VectorXd a = values(coupled), b = values(plain);
  EXPECT_LT(a.head<6>().cwiseAbs().maxCoeff(), 1e-8 * a(6));
  for (Eigen::Index k = 6; k < 30; ++k) EXPECT_NEAR(a(k) / b(k), 1.0, 1e-9);
  EXPECT_EQ(coupled.size(), plain.size());  // coordinates change, their number does not
}

TEST(Elimination, GroupsKeepTheMatricesOfALargeFaceSparse) {
  const mesh::Mesh mesh = ring_mesh(20, 6);
  const fe::FeModel plain = build(mesh, "").model;
  const fe::FeModel coupled =
      build(mesh, "[[coupling]]\nname = \"bore\"\nsurface = \"y0\"\n").model;
  const int64_t face = 3 * static_cast<int64_t>(mesh::nodes_of(mesh.surface("y0")).size());
  // A row over the entire face would add face^2 / 2 entries; groups of 24 nodes a few per cent.
  EXPECT_LT(coupled.K.nonZeros() - plain.K.nonZeros(), face * face / 10);
  EXPECT_EQ(coupled.size(), plain.size());
}

TEST(Elimination, RefusesARowThatAnotherCouplingAlreadyGives) {
  const std::string twice = R"(
[[mean]]
name = "a"
surface = "z1"
direction = [0.0, 0.0, 1.0]
[[mean]]
name = "b"
surface = "z1"
direction = [0.0, 0.0, 1.0]
)";
  try {
    build(small_ring(), twice);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mean b"), std::string::npos) << error.what();
  }
}

TEST(Elimination, RefusesACouplingWhoseNodesAreAllHeld) {
  test::expect_parts(
      test::refusal_of([&] {
        build(small_ring(),
              "[[support]]\nsurface = \"z1\"\n[[coupling]]\nname = \"top\"\nsurface = "
              "\"z1\"\n");
      }),
      {"test.fe.toml:",
       "coupling top: found rows that supports, sensors or other couplings already determine",
       "expected 6 independent coordinates"});
}

TEST(Elimination, SensorsOnACoupledFaceStayPlainDisplacements) {
  const mesh::Mesh mesh = small_ring();
  const fe::FeModel model = build(mesh, R"(
[[coupling]]
name = "bore"
surface = "y0"
[[sensor]]
name = "probe"
surface = "y0"
near = [0.04, 0.0, 0.05]
)")
                                .model;
  const rom::DofSet& probe = model.set("probe");
  ASSERT_EQ(probe.dofs.size(), 3u);
  EXPECT_LT((probe.position.row(0) - Eigen::RowVector3d(0.04, 0.0, 0.05)).norm(), 1e-12);
  EXPECT_EQ(probe.labels[1], "probe.y");
  for (const int32_t dof : probe.dofs) {
    ASSERT_GE(dof, 0);
    // A coordinate that is a displacement of one node: its column of T has a one there.
    double largest = 0.0;
    for (SparseMatrix::InnerIterator it(model.T, dof); it; ++it)
      largest = std::max(largest, it.value());
    EXPECT_GE(largest, 1.0);
  }
}

}  // namespace
}  // namespace clatter::assembly::testing
