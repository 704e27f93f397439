#include "assembly/element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "mesh/cell.hpp"
#include "mesh/shape.hpp"
#include "mesh/validity.hpp"

namespace clatter::assembly {
namespace {

CellNodes<4> unit_tet4() {
  CellNodes<4> x;
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  return x;
}

CellNodes<10> to_tet10(const CellNodes<4>& corners) {
  CellNodes<10> x;
  x.topRows<4>() = corners;
  for (int e = 0; e < 6; ++e) {
    const auto [i, j] = mesh::kTetEdges[static_cast<size_t>(e)];
    x.row(4 + e) = 0.5 * (corners.row(i) + corners.row(j));
  }
  return x;
}

CellNodes<10> curved_tet10() {
  CellNodes<10> x = to_tet10(unit_tet4());
  x.row(4) += Eigen::RowVector3d(0.02, -0.08, 0.01);
  x.row(8) += Eigen::RowVector3d(0.05, 0.06, 0.07);
  x.row(9) += Eigen::RowVector3d(0.04, -0.03, 0.05);
  return x;
}

TEST(Shape, QuadraticFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  const CellNodes<10> nodes = to_tet10(unit_tet4());
  for (int b = 0; b < 10; ++b) {
    const auto shape = mesh::cell_shape(mesh::CellType::kTet10, nodes.row(b).transpose());
    for (int a = 0; a < 10; ++a) EXPECT_NEAR(shape.value(a), a == b ? 1.0 : 0.0, 1e-15);
  }
}

TEST(Shape, GradientsAreTheDifferenceQuotientsOfTheValues) {
  const Eigen::Vector3d at(0.2, 0.3, 0.1);
  const double h = 1e-6;
  const auto shape = mesh::cell_shape(mesh::CellType::kTet10, at);
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(d);
    const Eigen::Matrix<double, 10, 1> slope =
        (mesh::cell_shape(mesh::CellType::kTet10, at + step).value -
         mesh::cell_shape(mesh::CellType::kTet10, at - step).value) /
        (2.0 * h);
    // Central differences are exact for quadratics; 1e-16 / 1e-6 of rounding remains.
    EXPECT_LT((slope - shape.gradient.col(d)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Element, MassOfALinearTetrahedronIsTheTextbookOne) {
  // rho V / 20 (1 + delta_ab): 120 * (1/6) / 20 = 1.
  ElementMatrices<4> cell;
  compute_element<4>(unit_tet4(), {1.0, 0.0, 120.0}, cell);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) EXPECT_NEAR(cell.mass(a, b), a == b ? 2.0 : 1.0, 1e-13);
}

TEST(Element, MassOfAStraightQuadraticTetrahedronIsTheTextbookOne) {
  // rho V / 420: corners 6 and 1, corner-middle -4 on its edges and -6 off them, middles 32, 16
  // (edges that share a corner), 8 (opposite edges). Zienkiewicz and Taylor by exact integration.
  ElementMatrices<10> cell;
  compute_element<10>(to_tet10(unit_tet4()), {1.0, 0.0, 6.0 * 420.0}, cell);
  EXPECT_NEAR(cell.mass(0, 0), 6.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 1), 1.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 4), -4.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 5), -6.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 8), -6.0, 1e-12);
  EXPECT_NEAR(cell.mass(4, 4), 32.0, 1e-12);
  EXPECT_NEAR(cell.mass(4, 5), 16.0, 1e-12);
  EXPECT_NEAR(cell.mass(4, 8), 8.0, 1e-12);
}

TEST(Element, StiffnessOfTheUnitTetrahedronByHand) {
  // E = 1, nu = 0: lambda = 0, mu = 1/2. Node 1 has the gradient (1, 0, 0), node 0 (-1, -1, -1).
  // K(1x, 1x) = V (lambda + 2 mu) = 1/6, K(1y, 1y) = V mu = 1/12,
  // K(0x, 0x) = V (mu (1 + 3)) = 1/3, K(0x, 0y) = V mu = 1/12, K(1x, 2y) = 0, K(1y, 2x) = V mu.
  ElementMatrices<4> cell;
  compute_element<4>(unit_tet4(), {1.0, 0.0, 1.0}, cell);
  const auto& K = cell.stiffness;
  EXPECT_NEAR(K(3, 3), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(K(4, 4), 1.0 / 12.0, 1e-15);
  EXPECT_NEAR(K(0, 0), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(K(0, 1), 1.0 / 12.0, 1e-15);
  EXPECT_NEAR(K(3, 7), 0.0, 1e-15);
  EXPECT_NEAR(K(4, 6), 1.0 / 12.0, 1e-15);
  EXPECT_DOUBLE_EQ(cell.min_jacobian, 1.0);
}

TEST(Element, CurvedMassHoldsTheExactVolume) {
  ElementMatrices<10> cell;
  const CellNodes<10> x = curved_tet10();
  compute_element<10>(x, {1.0, 0.3, 1.0}, cell);
  EXPECT_FALSE(is_straight<10>(x));
  // Volume by Bezier coefficients of det J: another formula. 1e-13: rounding of 64 points.
  EXPECT_NEAR(cell.mass.sum() / mesh::volume_of(x), 1.0, 1e-13);
}

TEST(Element, ACellHasExactlySixMotionsWithoutEnergy) {
  for (const CellNodes<10>& x : {to_tet10(unit_tet4()), curved_tet10()}) {
    ElementMatrices<10> cell;
    compute_element<10>(x, {1.0, 0.3, 1.0}, cell);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(cell.stiffness));
    const double top = eigen.eigenvalues()(29);
    EXPECT_LT(std::abs(eigen.eigenvalues()(5)), 1e-14 * top);
    EXPECT_GT(eigen.eigenvalues()(6), 1e-4 * top);
  }
}

TEST(Element, StiffnessTurnsWithTheCell) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  ElementMatrices<10> here, there;
  compute_element<10>(curved_tet10(), {1.0, 0.3, 1.0}, here);
  compute_element<10>(curved_tet10() * turn.transpose(), {1.0, 0.3, 1.0}, there);
  Eigen::Matrix<double, 30, 30> Q = Eigen::Matrix<double, 30, 30>::Zero();
  for (int a = 0; a < 10; ++a) Q.block<3, 3>(3 * a, 3 * a) = turn;
  EXPECT_LT((Q * here.stiffness * Q.transpose() - there.stiffness).cwiseAbs().maxCoeff(),
            1e-13 * here.stiffness.cwiseAbs().maxCoeff());
}

TEST(Element, AnInvertedCellIsReported) {
  CellNodes<10> x = to_tet10(unit_tet4());
  x.col(0) *= -1.0;
  ElementMatrices<10> cell;
  compute_element<10>(x, {1.0, 0.3, 1.0}, cell);
  EXPECT_LE(cell.min_jacobian, 0.0);
}

}  // namespace
}  // namespace clatter::assembly
