// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "assembly/coupling/coupling.hpp"
#include "assembly/load/mass_properties.hpp"
#include "block_mesh.hpp"
#include "core/base/threads.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/fe/assemble.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

mesh::Mesh curved_ring(int around = 8) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  return block_mesh({around, 1, 2}, ring(0.04, 0.06, 0.1), options);
}

Eigen::MatrixXd rigid_of(const mesh::Mesh& mesh) {
  Eigen::MatrixXd rigid(3 * mesh.nodes.rows(), 6);
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    rigid.middleRows<3>(3 * a) = rigid_motion(mesh.nodes.row(a).transpose());
  return rigid;
}

TEST(AssemblyInvariant, RigidMotionsNeedNoForceAlsoFarFromTheOrigin) {
  mesh::Mesh mesh = curved_ring();
  mesh.nodes.rowwise() += Eigen::RowVector3d(1.0, -2.0, 0.5);
  const fe::NodalMatrices matrices = fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh));
  const Eigen::MatrixXd force = multiply_symmetric(matrices.K, rigid_of(mesh));
  // Rounding of sums of some hundred terms, times the distance over the cell size.
  EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-12 * Eigen::VectorXd(matrices.K.diagonal()).maxCoeff());
}

TEST(AssemblyInvariant, AFreeBodyHasExactlySixMotionsWithoutEnergy) {
  const mesh::Mesh mesh = block_mesh({1, 1, 2}, brick({0.1, 0.1, 0.2}));
  const fe::NodalMatrices matrices = fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh));
  const Eigen::VectorXd values =
      dense::symmetric_eigen(full(matrices.K), dense::EigenParts::kValues).values;
  EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-9 * values(6));
}

TEST(AssemblyInvariant, MassOfABrickIsExact) {
  const std::array<int, 3> n = {3, 2, 2};
  for (const mesh::CellType type : {mesh::CellType::kTet4, mesh::CellType::kTet10}) {
    BlockOptions options;
    options.type = type;
    const mesh::Mesh mesh = block_mesh(n, shaken_brick({0.3, 0.2, 0.1}, n, 0.2), options);
    const fe::NodalMatrices matrices =
        fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh));
    const rom::MassProperties mass = properties_of(matrices.M, rigid_of(mesh));
    const double m = 7800.0 * 0.3 * 0.2 * 0.1;
    EXPECT_NEAR(mass.mass / m, 1.0, 1e-13);
    EXPECT_LT((mass.centre - Eigen::Vector3d(0.15, 0.1, 0.05)).norm(), 1e-13);
    const Eigen::Vector3d square(0.09, 0.04, 0.01);  // a^2, b^2, c^2
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(mass.inertia(d, d) / (m / 12.0 * (square.sum() - square(d))), 1.0, 1e-12);
    EXPECT_LT(std::abs(mass.inertia(0, 1)) + std::abs(mass.inertia(1, 2)), 1e-13);
  }
}

TEST(AssemblyInvariant, LumpedMassOfQuadraticCellsIsPositiveWithAnInertiaOfSecondOrder) {
  const double m = 7800.0 * 0.3 * 0.2 * 0.1;
  for (const mesh::CellType type : {mesh::CellType::kTet10, mesh::CellType::kHex20,
                                    mesh::CellType::kWedge15, mesh::CellType::kPyramid13}) {
    double coarser = 0.0;
    for (const int n : {1, 2, 4}) {
      const mesh::Mesh mesh = block_mesh({n, n, n}, brick({0.3, 0.2, 0.1}), {.type = type});
      const SparseMatrix M =
          fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh), fe::MassForm::kHrz).M;
      EXPECT_EQ(M.nonZeros(), M.cols());
      EXPECT_GT(Eigen::VectorXd(M.diagonal()).minCoeff(), 0.0) << mesh::traits(type).name;
      const rom::MassProperties mass = properties_of(M, rigid_of(mesh));
      EXPECT_NEAR(mass.mass / m, 1.0, 1e-13);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> inertia(mass.inertia);
      EXPECT_GT(inertia.eigenvalues().minCoeff(), 0.0);
      const double error = std::abs(mass.inertia(2, 2) / (m / 12.0 * 0.13) - 1.0);
      if (n > 1) {
        EXPECT_GT(coarser / error, 3.5) << mesh::traits(type).name << " " << n;
      }
      coarser = error;
    }
  }
}

TEST(AssemblyInvariant, MatricesAndIntegralsGiveTheSameTenMassProperties) {
  const mesh::Mesh mesh = curved_ring();
  const fe::NodalMatrices matrices = fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh));
  const MassDifference error = compare(properties_of(matrices.M, rigid_of(mesh)),
                                       properties_of(integrate_mass(mesh, materials_of(mesh))));
  EXPECT_LT(error.mass, 1e-13);
  EXPECT_LT(error.centre, 1e-12);
  EXPECT_LT(error.inertia, 1e-12);
}

TEST(AssemblyInvariant, MassOfACurvedRingTendsToTheCylindersWithFourthOrder) {
  const double exact = 7800.0 * std::numbers::pi * (0.06 * 0.06 - 0.04 * 0.04) * 0.1;
  const auto error = [&](int around) {
    const mesh::Mesh mesh = curved_ring(around);
    return std::abs(integrate_mass(mesh, materials_of(mesh)).mass / exact - 1.0);
  };
  // Parabolic arcs deviate from the circle by O(h^4) in the mean.
  EXPECT_NEAR(std::log2(error(8) / error(16)), 4.0, 0.2);
}

TEST(AssemblyInvariant, BitsDoNotDependOnTheThreadCount) {
  const std::array<int, 3> n = {9, 8, 8};  // 3456 cells: several chunks
  const mesh::Mesh mesh = block_mesh(n, shaken_brick({0.3, 0.2, 0.1}, n, 0.2));
  std::vector<fe::NodalMatrices> runs;
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    runs.push_back(fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh)));
  }
  set_thread_count(0);
  for (size_t r = 1; r < runs.size(); ++r) {
    ASSERT_EQ(runs[0].K.nonZeros(), runs[r].K.nonZeros());
    const auto bytes = sizeof(double) * static_cast<size_t>(runs[0].K.nonZeros());
    EXPECT_EQ(std::memcmp(runs[0].K.valuePtr(), runs[r].K.valuePtr(), bytes), 0);
    const auto mass_bytes = sizeof(double) * static_cast<size_t>(runs[0].M.nonZeros());
    EXPECT_EQ(std::memcmp(runs[0].M.valuePtr(), runs[r].M.valuePtr(), mass_bytes), 0);
  }
}

TEST(AssemblyInvariant, TwoRegionsAddUp) {
  mesh::Mesh mesh = block_mesh({2, 1, 1}, brick({0.2, 0.1, 0.1}));
  const IndexMatrix all = mesh.cells[0].nodes;
  mesh.regions = {"body", "liner"};
  mesh.cells.push_back({mesh::CellType::kTet10, 1, all.bottomRows(6), {}});
  mesh.cells[0].nodes = all.topRows(6);
  const std::vector<fe::Material> two = {{2e11, 0.3, 8000.0}, {1e11, 0.3, 2000.0}};
  EXPECT_NEAR(integrate_mass(mesh, two).mass, 0.001 * (8000.0 + 2000.0), 1e-12);
  const fe::NodalMatrices matrices = fe::assemble(mesh, two, fe::node_pattern(mesh));
  EXPECT_NEAR(properties_of(matrices.M, rigid_of(mesh)).mass, 10.0, 1e-11);
}

}  // namespace
}  // namespace clatter::assembly::testing
