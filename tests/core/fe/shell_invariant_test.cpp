// SPDX-License-Identifier: GPL-3.0-or-later
// Shells as rigid bodies and warmed: no strain, no drift, the mass of a slab.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/dense/symmetric_eigen.hpp"
#include "shell_meshes.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::fe::testing {
namespace {

const Plate kPlate{.E = 3.0, .nu = 0.3, .rho = 2.0, .thickness = 0.1};

/// A plane cell, oblique in space, with straight sides.
ShellNodes plane_cell(int n) {
  const int corners = n > 4 ? n / 2 : n;
  ShellNodes x(4, 3);
  x << 0.1, 0.0, 0.0, 1.3, 0.2, 0.0, 1.0, 0.9, 0.0, -0.1, 1.1, 0.0;
  x.conservativeResize(n, Eigen::NoChange);
  for (int i = corners; i < n; ++i)
    x.row(i) = 0.5 * (x.row(i - corners) + x.row((i - corners + 1) % corners));
  const Eigen::Matrix3d Q =
      Eigen::AngleAxisd(0.9, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  const ShellNodes turned = (x * Q.transpose()).rowwise() + Eigen::RowVector3d(0.4, -0.3, 0.2);
  return turned;
}

/// Warped by a fifth of its size where it has four nodes or more, tapered, with offset, directors
/// inclined.
ShellCell odd_cell(int n, unsigned seed) {
  const ShellNodes x = plane_cell(n) + (n > 4 ? 0.04 : 0.1) * test::random_matrix(n, 3, seed);
  ShellCell cell = cell_alone(x, kPlate);
  cell.directors += 0.1 * test::random_matrix(n, 3, seed + 100);
  cell.directors.rowwise().normalize();
  cell.ratio = Eigen::VectorXd::Ones(n) + 0.3 * test::random_vector(n, seed + 200);
  cell.offset = 0.07;
  cell.stiffness.B << 2e-3, 1e-3, 3e-4, 1e-3, 3e-3, 0.0, 3e-4, 0.0, 1e-3;
  return cell;
}

ShellMatrices matrices_of(const ShellCell& cell, MassForm form = MassForm::kConsistent) {
  ShellMatrices out;
  EXPECT_TRUE(compute_shell(cell, form, out));
  return out;
}

class ShellOfNodes : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Cells, ShellOfNodes, ::testing::Values(3, 4, 6, 8));

TEST_P(ShellOfNodes, RigidMotionsHaveNoForce) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ShellCell cell = odd_cell(GetParam(), seed);
    const ShellMatrix K = matrices_of(cell).stiffness;
    const Eigen::MatrixXd force = K * rigid_motions(cell.x);
    EXPECT_LE(force.cwiseAbs().maxCoeff(), 1e-14 * K.cwiseAbs().maxCoeff());  // rounding
  }
}

TEST_P(ShellOfNodes, FreeExpansionHasNoForceAndNoStress) {
  constexpr double kWarmed = 1e-3;  // alpha dT
  const Eigen::VectorXd warm = Eigen::VectorXd::Constant(GetParam(), kWarmed);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ShellCell cell = odd_cell(GetParam(), seed);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * GetParam());
    for (int i = 0; i < GetParam(); ++i) u.segment<3>(6 * i) = kWarmed * cell.x.row(i).transpose();
    const Eigen::VectorXd held = shell_thermal_force(cell, warm);
    EXPECT_GT(held.norm(), 0.1 * kWarmed * kPlate.E * kPlate.thickness);
    EXPECT_LE((matrices_of(cell).stiffness * u - held).norm(), 1e-12 * held.norm());  // rounding
    const ShellStrains e = shell_strains(cell, u, {0.3, 0.2}, warm);
    EXPECT_LE(e.membrane.norm() + e.curvature.norm() + e.shear.norm(), 1e-12 * kWarmed);
    EXPECT_GT(shell_strains(cell, u, {0.3, 0.2}).membrane.norm(), 0.5 * kWarmed);
  }
}

TEST_P(ShellOfNodes, ExactlySixEigenvaluesVanish) {
  ShellCell plane = cell_alone(plane_cell(GetParam()), kPlate);
  for (const ShellCell& cell : {plane, odd_cell(GetParam(), 3)}) {
    const Eigen::VectorXd values =
        dense::symmetric_eigen(matrices_of(cell).stiffness, dense::EigenParts::kValues).values;
    EXPECT_LE(values.head<6>().cwiseAbs().maxCoeff(), 1e-14 * values.tail<1>()(0));
    // Of the drilling rotations, 1e-4 G t.
    EXPECT_GE(values(6), 1e-10 * values.tail<1>()(0));
  }
}

/// int dA, int x dA, int x x^T dA of a triangle.
struct Moments {
  double area = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const double A = 0.5 * (b - a).cross(c - a).norm();
    const Eigen::Vector3d sum = a + b + c;
    area += A;
    first += A / 3.0 * sum;
    second += A / 12.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
};

/// Of a slab: int rho (u . u) over its volume for six rigid motions.
Eigen::MatrixXd slab(const ShellNodes& x, const Plate& plate) {
  Moments m;
  for (Eigen::Index i = 2; i < (x.rows() > 4 ? x.rows() / 2 : x.rows()); ++i)
    m.add(x.row(0), x.row(i - 1), x.row(i));
  const Eigen::Vector3d a = x.row(1) - x.row(0), b = x.row(2) - x.row(0),
                        n = a.cross(b).normalized();
  const double t = plate.thickness;
  m.second += m.area * t * t / 12.0 * n * n.transpose();
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(6, 6);
  R.topLeftCorner<3, 3>() = m.area * Eigen::Matrix3d::Identity();
  for (int d = 0; d < 3; ++d) R.block<3, 1>(0, 3 + d) = Eigen::Vector3d::Unit(d).cross(m.first);
  R.bottomLeftCorner<3, 3>() = R.topRightCorner<3, 3>().transpose();
  R.bottomRightCorner<3, 3>() = m.second.trace() * Eigen::Matrix3d::Identity() - m.second;
  return plate.rho * t * R;
}

TEST_P(ShellOfNodes, MassOfAPlaneCellIsThatOfTheSlab) {
  ShellCell cell = cell_alone(plane_cell(GetParam()), kPlate);
  const Eigen::MatrixXd R = rigid_motions(cell.x), exact = slab(cell.x, kPlate);
  Eigen::MatrixXd found = R.transpose() * matrices_of(cell).mass * R;
  EXPECT_LE((found - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
  // With nodes beside the mid-surface, which has the same position.
  const ShellNodes nodes = cell.x - 0.3 * cell.directors;
  cell.x = nodes;
  cell.offset = 0.3;
  const Eigen::MatrixXd moved = rigid_motions(cell.x);
  found = moved.transpose() * matrices_of(cell).mass * moved;
  EXPECT_LE((found - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
}

TEST_P(ShellOfNodes, LumpedMassHasTheTotalAndNoMassAboutTheDirector) {
  const ShellCell cell = cell_alone(plane_cell(GetParam()), kPlate);
  const ShellMatrix M = matrices_of(cell, MassForm::kHrz).mass;
  const Eigen::MatrixXd R = rigid_motions(cell.x), exact = slab(cell.x, kPlate);
  const Eigen::MatrixXd error = (R.transpose() * M * R - exact).topLeftCorner(3, 3);
  EXPECT_LE(error.cwiseAbs().maxCoeff(), 1e-14 * exact(0, 0));
  if (GetParam() == 8) return;  // its centre's mass moves with all nodes
  Eigen::MatrixXd beside = M;
  for (Eigen::Index i = 0; i < cell.x.rows(); ++i) {
    const Eigen::Matrix3d inertia = M.block(6 * i + 3, 6 * i + 3, 3, 3);
    EXPECT_LE((inertia * cell.directors.row(i).transpose()).norm(), 1e-15 * inertia.norm());
    beside.block(6 * i, 6 * i, 6, 6).setZero();
  }
  EXPECT_EQ(beside.cwiseAbs().maxCoeff(), 0.0);
}

TEST(ShellMass, HardU7_ASheetTiltedByRoundingHasNoMassAboutItsNormal) {
  Plate plate = kPlate;
  for (const double angle : {1e-9, 3e-7}) {
    const Eigen::Matrix3d tilt =
        Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 2.0, 0.0).normalized()).toRotationMatrix();
    plate.offset = 3e3 * angle;
    ShellNodes x(8, 3);
    x << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, 0, 1, 0.5, 0, 0.5, 1, 0, 0, 0.5, 0;
    for (const int n : {4, 8}) {
      const ShellNodes tilted = x.topRows(n) * tilt.transpose();
      ShellMatrices out;
      ASSERT_TRUE(compute_shell(cell_alone(tilted, plate), MassForm::kConsistent, out));
      for (int node = 0; node < n; ++node) {
        EXPECT_EQ(out.mass.row(6 * node + 5).cwiseAbs().maxCoeff(), 0.0) << n;
        EXPECT_GT(out.mass(6 * node + 3, 6 * node + 3), 0.0) << n;
      }
    }
  }
}

TEST_P(ShellOfNodes, MatricesAreSymmetric) {
  const ShellMatrices m = matrices_of(odd_cell(GetParam(), 5));
  for (const ShellMatrix& A : {m.stiffness, m.mass})
    EXPECT_LE((A - A.transpose()).cwiseAbs().maxCoeff(), 1e-15 * A.cwiseAbs().maxCoeff());
}

TEST(Shell, FrequenciesDoNotDependOnWhereTheNodesOfAPlateLie) {
  Plate plate{.E = 210e9, .nu = 0.3, .rho = 7850.0, .thickness = 1.5e-3};
  const auto map = [](double u, double v) { return Eigen::Vector3d(0.3 * u, 0.2 * v, 0.0); };
  for (const Cells cells :
       {Cells::kQuads, Cells::kTriangles, Cells::kMixed, Cells::kQuads8, Cells::kTriangles6})
    for (const MassForm form : {MassForm::kConsistent, MassForm::kHrz}) {
      plate.mass = form;
      plate.offset = 0.0;
      Sheet sheet = mapped(map, 6, 4, cells);
      const Eigen::VectorXd at_middle = frequencies(assemble(sheet, plate), {}, 12, 50.0);
      sheet.nodes.col(2).array() += 0.5 * plate.thickness;
      plate.offset = -0.5 * plate.thickness;
      const Eigen::VectorXd at_face = frequencies(assemble(sheet, plate), {}, 12, 50.0);
      EXPECT_LE((at_face - at_middle).tail(6).cwiseAbs().maxCoeff(), 1e-10 * at_middle(11));
    }
}

}  // namespace
}  // namespace clatter::fe::testing
