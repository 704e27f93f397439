// SPDX-License-Identifier: GPL-3.0-or-later
// [prestress]: the geometric stiffness of solids and beams.
#include "core/fe/prestress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>

#include "block_mesh.hpp"
#include "core/fe/assemble.hpp"
#include "core/fe/beam.hpp"
#include "core/fe/element.hpp"
#include "one_cell.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr std::array<int, 3> kCells = {2, 2, 2};
const Eigen::Vector3d kSize(1.0, 0.8, 1.2);

Eigen::Matrix3d some_gradient() {
  Eigen::Matrix3d A;
  A << 1.0, 0.3, -0.2, 0.5, -0.7, 0.4, 0.1, 0.6, 0.9;
  return A;
}

Eigen::VectorXd stacked(const RowMatrix& rows) { return rows.reshaped<Eigen::RowMajor>(); }

SparseMatrix of_mesh(const mesh::Mesh& mesh, const fe::Prestress& state) {
  const fe::ShellIds ids{3 * mesh.nodes.rows(), {}};
  return fe::geometric_stiffness(mesh, materials_of(mesh, kSteel), {}, fe::node_pattern(mesh), ids,
                                 state);
}

class PrestressOfCells : public ::testing::TestWithParam<mesh::CellType> {};
INSTANTIATE_TEST_SUITE_P(AllCells, PrestressOfCells, ::testing::ValuesIn(kAllCells));

// Of u = A x beside a constant stress the energy is V sigma : A^T A / 2.
TEST_P(PrestressOfCells, AConstantStressIsExactOnDistortedCells) {
  BlockOptions options;
  options.type = GetParam();
  const mesh::Mesh mesh = block_mesh(kCells, shaken_brick(kSize, kCells, 0.2), options);
  Eigen::Matrix3d strain;
  strain << 2e-3, 4e-4, -3e-4, 4e-4, -1e-3, 6e-4, -3e-4, 6e-4, 5e-4;
  fe::Prestress state;
  state.displacement = mesh.nodes * strain;
  state.factor = 2.0;
  const SparseMatrix G = of_mesh(mesh, state);
  const Eigen::Matrix3d stress =
      kSteel.lambda() * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * kSteel.mu() * strain;
  const Eigen::Matrix3d A = some_gradient();
  const Eigen::VectorXd motion = stacked(mesh.nodes * A.transpose());
  const double expected = 2.0 * kSize.prod() * (A * stress * A.transpose()).trace();
  EXPECT_NEAR(motion.dot(multiply_symmetric(G, motion).col(0)) / expected, 1.0, 1e-11);
}

// A rotation turns the forces at the nodes, which hold the stress: K_g (w x x) = w x f, on any
// cell, also of temperatures.
TEST_P(PrestressOfCells, ARotationTurnsTheForces) {
  const mesh::CellNodes x = distorted(GetParam());
  const Eigen::Index n = x.rows();
  mesh::Mesh mesh;
  mesh.nodes = x;
  mesh.regions = {"body"};
  mesh::CellBlock block;
  block.type = GetParam();
  block.nodes = Eigen::RowVectorXi::LinSpaced(n, 0, static_cast<int>(n) - 1);
  mesh.cells = {block};
  fe::Prestress state;
  state.displacement = 1e-3 * (x.array() * 3.0 + x.rowwise().sum().replicate(1, 3).array()).sin();
  state.temperature = 40.0 * x.col(0).array().cos();
  fe::Material material = kSteel;
  material.expansion << 1.2e-5, 1.2e-5, 1.2e-5, 0.0, 0.0, 0.0;
  const fe::ShellIds ids{3 * n, {}};
  const SparseMatrix G = fe::geometric_stiffness(mesh, materials_of(mesh, material), {},
                                                 fe::node_pattern(mesh), ids, state);
  fe::ElementMatrices cell;
  fe::compute_element(GetParam(), x, material, cell);
  const Eigen::VectorXd force = cell.stiffness * stacked(state.displacement) -
                                fe::thermal_force(GetParam(), x, material, state.temperature);
  const Eigen::Vector3d w(0.3, -0.8, 0.5);
  Eigen::VectorXd turn(3 * n), turned(3 * n);
  for (Eigen::Index a = 0; a < n; ++a) {
    turn.segment<3>(3 * a) = w.cross(Eigen::Vector3d(x.row(a)));
    turned.segment<3>(3 * a) = w.cross(Eigen::Vector3d(force.segment<3>(3 * a)));
  }
  EXPECT_LE((multiply_symmetric(G, turn).col(0) - turned).norm(), 1e-10 * force.norm());
}

// --- beams ---

fe::BeamElement rod(double length, double EI, double shear) {
  fe::BeamSection section;
  section.EA = 1e6;
  section.GJ = 1.0;
  section.EI1 = section.EI2 = EI;
  section.shear1 = section.shear2 = shear;
  fe::BeamElement beam;
  beam.length = length;
  beam.stations = {{0.0, section}};
  return beam;
}

/// The least load that buckles a column with hinged ends, of `count` beams.
double buckling_load(double length, double EI, double shear, int count) {
  const fe::BeamElement beam = rod(length / count, EI, shear);
  const fe::BeamMatrix K = fe::beam_stiffness(beam), G = fe::beam_stiffness(beam, 1.0) - K;
  // v and rz of each node.
  constexpr std::array<int, 4> kRows = {1, 5, 7, 11};
  const int size = 2 * (count + 1);
  Eigen::MatrixXd stiff = Eigen::MatrixXd::Zero(size, size), slopes = stiff;
  for (int e = 0; e < count; ++e)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        stiff(2 * e + i, 2 * e + j) += K(kRows[i], kRows[j]);
        slopes(2 * e + i, 2 * e + j) += G(kRows[i], kRows[j]);
      }
  std::vector<int> free;
  for (int k = 0; k < size; ++k)
    if (k != 0 && k != size - 2) free.push_back(k);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(slopes(free, free),
                                                                        stiff(free, free));
  return 1.0 / eigen.eigenvalues().maxCoeff();
}

TEST(PrestressOfBeams, AColumnBucklesAtEulersLoad) {
  const double L = 2.0, EI = 50.0, euler = std::numbers::pi * std::numbers::pi * EI / (L * L);
  EXPECT_NEAR(buckling_load(L, EI, 0.0, 8) / euler, 1.0, 1e-4);
  // Of order 4: cubic deflections.
  const double ratio =
      (buckling_load(L, EI, 0.0, 2) / euler - 1.0) / (buckling_load(L, EI, 0.0, 4) / euler - 1.0);
  EXPECT_NEAR(std::log2(ratio), 4.0, 0.2);
}

// Engesser: soft in shear it buckles at P / (1 + P / (k G A)).
TEST(PrestressOfBeams, ShearLowersTheLoad) {
  const double L = 2.0, EI = 50.0, euler = std::numbers::pi * std::numbers::pi * EI / (L * L);
  for (const double shear : {1e-4, 1e-3, 1e-2})
    EXPECT_NEAR(buckling_load(L, EI, shear, 16) * (1.0 / euler + shear), 1.0, 1e-3) << shear;
}

TEST(PrestressOfBeams, ATrussIsAString) {
  fe::BeamElement beam;
  beam.length = 0.5;
  fe::BeamSection section;
  section.EA = 1e6;
  beam.stations = {{0.0, section}};
  const fe::BeamMatrix G = fe::beam_stiffness(beam, 300.0) - fe::beam_stiffness(beam);
  fe::BeamMatrix expected = fe::BeamMatrix::Zero();
  for (const int d : {1, 2}) {
    expected(d, d) = expected(d + 6, d + 6) = 600.0;
    expected(d, d + 6) = expected(d + 6, d) = -600.0;
  }
  EXPECT_LE((G - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PrestressOfBeams, TheTensionIsThatOfTheEndsAlsoWithOffsetsAndReleases) {
  fe::BeamElement beam = rod(2.0, 50.0, 0.0);
  beam.axes =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  beam.released[1] = {4, 5};
  Eigen::Vector<double, 12> u = Eigen::Vector<double, 12>::Zero();
  u.segment<3>(6) = 2e-3 * beam.axes.col(0) + 0.1 * beam.axes.col(1);
  EXPECT_NEAR(fe::beam_tension(beam, u), 1000.0, 1e-9);
  beam.offset[1] = 0.3 * beam.axes.col(1);  // end b, moved by a rotation of its node about z
  u.segment<3>(9) = -0.01 * beam.axes.col(2);
  EXPECT_NEAR(fe::beam_tension(beam, u), 1000.0 + 1e6 / 2.0 * 0.003, 1e-9);
}

}  // namespace
}  // namespace clatter::assembly::testing
