// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/dense/symmetric_eigen.hpp"
#include "core/mesh/shape.hpp"
#include "one_cell.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellNodes;
using mesh::CellType;

const fe::Material kUnit{1.0, 0.3, 1.0};

fe::ElementMatrices element(CellType type, const CellNodes& x,
                            const fe::Material& material = kUnit) {
  fe::ElementMatrices out;
  fe::compute_element(type, x, material, out);
  return out;
}

TEST(Element, MassOfALinearTetrahedronIsTheTextbookOne) {
  // rho V / 20 (1 + delta_ab): 120 * (1/6) / 20 = 1.
  const fe::ElementMatrices cell =
      element(CellType::kTet4, reference(CellType::kTet4), {1, 0, 120});
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) EXPECT_NEAR(cell.mass(a, b), a == b ? 2.0 : 1.0, 1e-13);
}

TEST(Element, MassOfAStraightQuadraticTetrahedronIsTheTextbookOne) {
  // rho V / 420: corners 6 and 1, corner with mid-side node -4 on its edges and -6 off them,
  // mid-side nodes 32, 16 (edges that share a corner), 8 (opposite edges). Zienkiewicz and Taylor
  // by exact integration.
  const fe::ElementMatrices cell =
      element(CellType::kTet10, reference(CellType::kTet10), {1.0, 0.0, 6.0 * 420.0});
  EXPECT_NEAR(cell.mass(0, 0), 6.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 1), 1.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 4), -4.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 5), -6.0, 1e-12);
  EXPECT_NEAR(cell.mass(0, 8), -6.0, 1e-12);
  EXPECT_NEAR(cell.mass(4, 4), 32.0, 1e-12);
  EXPECT_NEAR(cell.mass(4, 5), 16.0, 1e-12);
  EXPECT_NEAR(cell.mass(4, 8), 8.0, 1e-12);
}

TEST(Element, MassOfALinearHexahedronIsTheTextbookOne) {
  // The cube of edge 2, rho = 27: a product of line masses (2/3, 1/3): 8, 4, 2, 1.
  const fe::ElementMatrices cell = element(CellType::kHex8, reference(CellType::kHex8), {1, 0, 27});
  EXPECT_NEAR(cell.mass(0, 0), 8.0, 1e-13);
  EXPECT_NEAR(cell.mass(0, 1), 4.0, 1e-13);
  EXPECT_NEAR(cell.mass(0, 2), 2.0, 1e-13);
  EXPECT_NEAR(cell.mass(0, 6), 1.0, 1e-13);
}

TEST(Element, StiffnessOfTheUnitTetrahedronByHand) {
  // E = 1, nu = 0: lambda = 0, mu = 1/2. Node 1 has the gradient (1, 0, 0), node 0 (-1, -1, -1).
  // K(1x, 1x) = V (lambda + 2 mu) = 1/6, K(1y, 1y) = V mu = 1/12,
  // K(0x, 0x) = V (mu (1 + 3)) = 1/3, K(0x, 0y) = V mu = 1/12, K(1x, 2y) = 0, K(1y, 2x) = V mu.
  const fe::ElementMatrices cell = element(CellType::kTet4, reference(CellType::kTet4), {1, 0, 1});
  const auto& K = cell.stiffness;
  EXPECT_NEAR(K(3, 3), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(K(4, 4), 1.0 / 12.0, 1e-15);
  EXPECT_NEAR(K(0, 0), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(K(0, 1), 1.0 / 12.0, 1e-15);
  EXPECT_NEAR(K(3, 7), 0.0, 1e-15);
  EXPECT_NEAR(K(4, 6), 1.0 / 12.0, 1e-15);
  EXPECT_DOUBLE_EQ(cell.min_jacobian, 1.0);
}

TEST(Element, OneIncompatibleHexahedronBendsAsABeamDoes) {
  // Pure bending of the cube of edge 2, nu = 0: u_x = x z, u_z = -x^2 / 2 + ... has the energy
  // 1/2 E int z^2 dV = 1/2 * 8/3. A full hex8 adds the shear of its missing curvature.
  const CellNodes x = reference(CellType::kHex8);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(24);
  for (int a = 0; a < 8; ++a) u(3 * a) = x(a, 0) * x(a, 2);
  fe::Material material{1.0, 0.0, 1.0};
  const Eigen::MatrixXd bends = element(CellType::kHex8, x, material).stiffness;
  EXPECT_NEAR(0.5 * u.dot(bends * u), 4.0 / 3.0, 1e-13);
  material.integration.hex8 = fe::Integration::kFull;
  const Eigen::MatrixXd locks = element(CellType::kHex8, x, material).stiffness;
  EXPECT_NEAR(0.5 * u.dot(locks * u), 4.0 / 3.0 + 2.0 / 3.0, 1e-13);  // + 1/2 mu int x^2
}

TEST(Element, AnOrthotropicCellWithIsotropicConstantsIsTheIsotropicOne) {
  fe::Material material = kUnit;
  material.elasticity = kUnit.elasticity_at(Eigen::Vector3d::Zero());
  material.axes =
      fe::Axes{fe::Axes::Kind::kCylindrical, {0.1, 0.2, -3.0}, Eigen::Matrix3d::Identity()};
  for (const CellType type : kAllCells) {
    const CellNodes x = distorted(type);
    const Eigen::MatrixXd one = element(type, x).stiffness;
    const Eigen::MatrixXd other = element(type, x, material).stiffness;
    EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-13 * one.cwiseAbs().maxCoeff())
        << mesh::traits(type).name;
  }
}

class EveryCell : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Element, EveryCell, ::testing::ValuesIn(kAllCells), [](const auto& info) {
  return std::string(mesh::traits(info.param).name);
});

TEST_P(EveryCell, MassHoldsTheExactVolumeOfADistortedCell) {
  const CellNodes x = distorted(GetParam());
  const fe::ElementMatrices cell = element(GetParam(), x);
  // The volume comes from another rule, for tetrahedra from Bezier coefficients.
  EXPECT_NEAR(cell.mass.sum() / mesh::volume_of(GetParam(), x), 1.0, 1e-12);
  // Each entry is a moment of two polynomials: twice as fine points change nothing. Checked by the
  // exact first moments: sum_ab m_ab x_a = int x dV, for which the divergence theorem is another
  // way.
  const Eigen::Vector3d first = x.transpose() * cell.mass.rowwise().sum();
  EXPECT_LT((first - first_moment(GetParam(), x)).norm(), 1e-12);
}

TEST_P(EveryCell, HasExactlySixMotionsWithoutEnergy) {
  for (const CellNodes& x : {reference(GetParam()), distorted(GetParam())}) {
    const Eigen::MatrixXd K = element(GetParam(), x).stiffness;
    const Eigen::VectorXd values = dense::symmetric_eigen(K, dense::EigenParts::kValues).values;
    const double top = values(values.size() - 1);
    EXPECT_LT(std::abs(values(5)), 1e-13 * top);
    EXPECT_GT(values(6), 1e-4 * top);
  }
}

TEST_P(EveryCell, StiffnessTurnsWithTheCell) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const CellNodes x = distorted(GetParam());
  const Eigen::MatrixXd here = element(GetParam(), x).stiffness;
  const Eigen::MatrixXd there = element(GetParam(), x * turn.transpose()).stiffness;
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(here.rows(), here.rows());
  for (Eigen::Index a = 0; a < x.rows(); ++a) Q.block<3, 3>(3 * a, 3 * a) = turn;
  EXPECT_LT((Q * here * Q.transpose() - there).cwiseAbs().maxCoeff(),
            1e-12 * here.cwiseAbs().maxCoeff());
}

TEST_P(EveryCell, AnInvertedCellIsReported) {
  CellNodes x = reference(GetParam());
  x.col(0) *= -1.0;
  EXPECT_LE(element(GetParam(), x).min_jacobian, 0.0);
}

TEST_P(EveryCell, LumpedMassIsPositiveWithTheSameTotal) {
  const Eigen::MatrixXd consistent = element(GetParam(), distorted(GetParam())).mass;
  Eigen::MatrixXd lumped = consistent;
  fe::lump_hrz(lumped);
  EXPECT_NEAR(lumped.sum() / consistent.sum(), 1.0, 1e-14);
  EXPECT_GT(lumped.diagonal().minCoeff(), 0.0);
  EXPECT_TRUE(lumped.isDiagonal(0.0));
}

TEST_P(EveryCell, FreeThermalExpansionNeedsNoForce) {
  // u = alpha dT x: the forces that hold it are the thermal ones. dT is uniform.
  fe::Material material{2.0, 0.25, 1.0};
  material.expansion.head<3>().setConstant(0.01);
  const CellNodes x = distorted(GetParam());
  const Eigen::MatrixXd K = element(GetParam(), x, material).stiffness;
  const Eigen::VectorXd f =
      fe::thermal_force(GetParam(), x, material, Eigen::VectorXd::Constant(x.rows(), 5.0));
  Eigen::VectorXd u(3 * x.rows());
  for (Eigen::Index a = 0; a < x.rows(); ++a) u.segment<3>(3 * a) = 0.05 * x.row(a).transpose();
  EXPECT_LT((K * u - f).norm(), 1e-12 * f.norm());
}

TEST(Element, AnOrthotropicCellExpandsAlongItsAxes) {
  // Axes turned by 30 degrees about z, expansion only along the first: strain a c^2, a s^2, 2 a s
  // c.
  fe::Material material{2.0, 0.25, 1.0};
  material.expansion(0) = 0.01;
  const double angle = M_PI / 6.0, c = std::cos(angle), s = std::sin(angle);
  material.axes = fe::Axes{fe::Axes::Kind::kRectangular, Eigen::Vector3d::Zero(),
                           Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix()};
  const fe::Voigt strain = material.expansion_at(Eigen::Vector3d::Zero());
  EXPECT_NEAR(strain(0), 0.01 * c * c, 1e-16);
  EXPECT_NEAR(strain(1), 0.01 * s * s, 1e-16);
  EXPECT_NEAR(strain(3), 0.02 * s * c, 1e-16);
}

}  // namespace
}  // namespace clatter::assembly::testing
