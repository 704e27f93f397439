// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/stress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/fe/cell_points.hpp"
#include "one_cell.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellNodes;
using mesh::CellType;
using Position = Eigen::Vector3d;
using Displacement = std::function<Eigen::Vector3d(const Position&)>;

constexpr double kExact = 1e-12;  // of the stresses: rounding of gradients and of the fit

Eigen::VectorXd displaced(const Eigen::Ref<const Eigen::Matrix<double, -1, 3, Eigen::RowMajor>>& x,
                          const Displacement& field) {
  Eigen::VectorXd u(3 * x.rows());
  for (Eigen::Index a = 0; a < x.rows(); ++a) u.segment<3>(3 * a) = field(x.row(a).transpose());
  return u;
}

/// Orthotropic, thermal, on axes oblique to the basic ones.
fe::Material spruce() {
  fe::Material material{0.0, 0.0, 450.0};
  fe::Elasticity compliance = fe::Elasticity::Zero();
  compliance.topLeftCorner<3, 3>() << 1.0, -0.4, -0.3, -0.4, 12.0, -5.0, -0.3, -5.0, 20.0;
  compliance.diagonal().tail<3>() << 15.0, 250.0, 18.0;
  material.elasticity = (1e-10 * compliance).inverse();
  material.expansion << 4e-6, 3e-5, 5e-5, 0.0, 0.0, 0.0;
  fe::Axes axes;
  axes.frame = Eigen::AngleAxisd(0.7, Position(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  material.axes = axes;
  return material;
}

fe::Material warm_steel() {
  fe::Material material = kSteel;
  material.expansion.head<3>().setConstant(1.2e-5);
  return material;
}

/// Stress of a constant displacement gradient by tensors: rotated to the material's axes, Hooke's
/// law there, rotated back.
fe::Voigt tensor_stress(const fe::Material& material, const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d R = material.axes ? material.axes->frame : Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d e = R.transpose() * (0.5 * (gradient + gradient.transpose())) * R;
  fe::Voigt strain;
  strain << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(2, 0);
  fe::Material on_axes = material;
  on_axes.axes.reset();
  const fe::Voigt s = on_axes.elasticity_at(Position::Zero()) * strain;
  Eigen::Matrix3d local;
  local << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), s(2);
  const Eigen::Matrix3d g = R * local * R.transpose();
  return (fe::Voigt() << g(0, 0), g(1, 1), g(2, 2), g(0, 1), g(1, 2), g(2, 0)).finished();
}

fe::FeCells cells_of(const mesh::Mesh& mesh, const fe::Material& material) {
  return {mesh.regions, materials_of(mesh, material), mesh.cells, {}, {}, {}};
}

mesh::Mesh mesh_of(CellType type, const Map& map) {
  BlockOptions options;
  options.type = type;
  return block_mesh({2, 2, 2}, map, options);
}

/// A parallelepiped: reference functions contain every polynomial of x of their degree.
Position sheared_position(const Position& x) {
  return {x(0) + 0.3 * x(1), 0.8 * x(1) - 0.1 * x(2), 1.2 * x(2) + 0.2 * x(0)};
}

double largest_error(const mesh::Mesh& mesh, const fe::RegionStress& found,
                     const std::function<fe::Voigt(const Position&)>& exact) {
  double error = 0.0, size = 0.0;
  for (size_t k = 0; k < found.nodes.size(); ++k) {
    const fe::Voigt want = exact(mesh.nodes.row(found.nodes[k]).transpose());
    const fe::Voigt have = found.stress.row(static_cast<Eigen::Index>(k)).transpose();
    error = std::max(error, (have - want).cwiseAbs().maxCoeff());
    size = std::max(size, want.cwiseAbs().maxCoeff());
  }
  return error / size;
}

class Stress : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(EveryCell, Stress, ::testing::ValuesIn(kAllCells), [](const auto& info) {
  return std::string(mesh::traits(info.param).name);
});

TEST_P(Stress, OfAConstantStrainIsExactAtEveryNodeOfADistortedMesh) {
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.3, -0.2, 0.5, -0.7, 0.4, 0.1, 0.6, 0.9;
  gradient *= 1e-3;
  const mesh::Mesh mesh = mesh_of(GetParam(), shaken_brick({1.0, 0.8, 1.2}, {2, 2, 2}, 0.2));
  const Eigen::VectorXd u = displaced(mesh.nodes, [&](const Position& x) { return gradient * x; });
  fe::Material full = kSteel;
  full.integration.hex8 = fe::Integration::kFull;
  for (const fe::Material& material : {kSteel, full, spruce()}) {
    const fe::Voigt want = tensor_stress(material, gradient);
    const auto found = fe::nodal_stress(mesh.nodes, cells_of(mesh, material), u, {});
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(found[0].nodes.size(), static_cast<size_t>(mesh.nodes.rows()));
    EXPECT_LT(largest_error(mesh, found[0], [&](const Position&) { return want; }), kExact);
  }
}

TEST_P(Stress, OfFreeThermalExpansionIsZero) {
  const mesh::Mesh mesh = mesh_of(GetParam(), shaken_brick({1.0, 0.8, 1.2}, {2, 2, 2}, 0.2));
  const Eigen::VectorXd dT = Eigen::VectorXd::Constant(mesh.nodes.rows(), 80.0);
  for (const fe::Material& material : {warm_steel(), spruce()}) {
    const Eigen::Matrix3d R = material.axes ? material.axes->frame : Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d strain =
        R * (80.0 * material.expansion.head<3>()).asDiagonal() * R.transpose();
    const Eigen::VectorXd u = displaced(mesh.nodes, [&](const Position& x) { return strain * x; });
    const auto free = fe::nodal_stress(mesh.nodes, cells_of(mesh, material), u, dT);
    const auto held = fe::nodal_stress(mesh.nodes, cells_of(mesh, material), 0.0 * u, dT);
    EXPECT_LT(free[0].stress.cwiseAbs().maxCoeff(), kExact * held[0].stress.cwiseAbs().maxCoeff());
  }
}

TEST_P(Stress, OfAFullyHeldWarmBodyIsHydrostatic) {
  const mesh::Mesh mesh = mesh_of(GetParam(), shaken_brick({1.0, 0.8, 1.2}, {2, 2, 2}, 0.2));
  const fe::Material steel = warm_steel();
  const auto held = fe::nodal_stress(mesh.nodes, cells_of(mesh, steel),
                                     Eigen::VectorXd::Zero(3 * mesh.nodes.rows()),
                                     Eigen::VectorXd::Constant(mesh.nodes.rows(), 50.0));
  const double pressure = steel.youngs * 1.2e-5 * 50.0 / (1.0 - 2.0 * steel.poisson);
  const fe::Voigt want = (fe::Voigt() << -1, -1, -1, 0, 0, 0).finished() * pressure;
  EXPECT_LT(largest_error(mesh, held[0], [&](const Position&) { return want; }), kExact);
  EXPECT_LT(held[0].von_mises.maxCoeff(), kExact * pressure);
}

class QuadraticStress : public Stress {};
INSTANTIATE_TEST_SUITE_P(QuadraticCell, QuadraticStress,
                         ::testing::Values(CellType::kTet10, CellType::kHex20, CellType::kWedge15,
                                           CellType::kPyramid13),
                         [](const auto& info) {
                           return std::string(mesh::traits(info.param).name);
                         });

/// u = (x^2 + y z, y^2 + z x, z^2 + x y): linear stress, which quadratic cells represent exactly.
TEST_P(QuadraticStress, ThatIsLinearIsExact) {
  const bool tet = mesh::traits(GetParam()).corners == 4;
  const mesh::Mesh mesh = mesh_of(
      GetParam(), tet ? shaken_brick({1.0, 0.8, 1.2}, {2, 2, 2}, 0.2) : Map(sheared_position));
  const Eigen::VectorXd u = displaced(mesh.nodes, [](const Position& x) -> Position {
    return {x(0) * x(0) + x(1) * x(2), x(1) * x(1) + x(2) * x(0), x(2) * x(2) + x(0) * x(1)};
  });
  for (const fe::Material& material : {kSteel, spruce()}) {
    const auto exact = [&](const Position& x) {
      Eigen::Matrix3d gradient;
      gradient << 2 * x(0), x(2), x(1), x(2), 2 * x(1), x(0), x(1), x(0), 2 * x(2);
      return tensor_stress(material, gradient);
    };
    const auto found = fe::nodal_stress(mesh.nodes, cells_of(mesh, material), u, {});
    EXPECT_LT(largest_error(mesh, found[0], exact), 10 * kExact);
  }
}

TEST(StressOfHex8, InPureBendingIsExactWithIncompatibleModesOnly) {
  // sigma_xx = E z: u = (x z, -nu y z, -(x^2 + nu (z^2 - y^2)) / 2).
  const double nu = kSteel.poisson;
  const mesh::Mesh mesh = mesh_of(CellType::kHex8, brick({1.0, 0.2, 0.3}));
  const Eigen::VectorXd u = displaced(mesh.nodes, [&](const Position& x) -> Position {
    return {x(0) * x(2), -nu * x(1) * x(2),
            -0.5 * (x(0) * x(0) + nu * (x(2) * x(2) - x(1) * x(1)))};
  });
  const auto exact = [](const Position& x) {
    fe::Voigt stress = fe::Voigt::Zero();
    stress(0) = kSteel.youngs * x(2);
    return stress;
  };
  fe::Material material = kSteel;
  EXPECT_LT(
      largest_error(mesh, fe::nodal_stress(mesh.nodes, cells_of(mesh, material), u, {})[0], exact),
      10 * kExact);
  material.integration.hex8 = fe::Integration::kFull;
  EXPECT_GT(
      largest_error(mesh, fe::nodal_stress(mesh.nodes, cells_of(mesh, material), u, {})[0], exact),
      0.1);
}

TEST(StressOfHex8, OfALinearTemperatureThatBendsFreelyIsZero) {
  // dT = 100 z K: a bar without supports takes the strain alpha dT everywhere.
  const fe::Material steel = warm_steel();
  const mesh::Mesh mesh = mesh_of(CellType::kHex8, brick({1.0, 0.2, 0.3}));
  const double k = 100.0 * 1.2e-5;
  const Eigen::VectorXd u = displaced(mesh.nodes, [&](const Position& x) -> Position {
    return k * Position(x(0) * x(2), x(1) * x(2), 0.5 * (x(2) * x(2) - x(0) * x(0) - x(1) * x(1)));
  });
  const Eigen::VectorXd dT = 100.0 * mesh.nodes.col(2);
  const auto found = fe::nodal_stress(mesh.nodes, cells_of(mesh, steel), u, dT);
  EXPECT_LT(found[0].stress.cwiseAbs().maxCoeff(), kExact * steel.youngs * k);
}

TEST(StressAcrossMaterials, JumpsAndIsNotAveraged) {
  mesh::Mesh mesh = mesh_of(CellType::kHex20, brick({1.0, 1.0, 1.0}));
  mesh::CellBlock upper = mesh.cells[0];
  const Eigen::Index half = upper.nodes.rows() / 2;
  upper.nodes = IndexMatrix(mesh.cells[0].nodes.bottomRows(half));
  upper.region = 1;
  mesh.cells[0].nodes = IndexMatrix(mesh.cells[0].nodes.topRows(half));
  mesh.cells.push_back(upper);
  fe::Material soft = kSteel;
  soft.youngs *= 0.5;
  const fe::FeCells cells{{"hard", "soft"}, {kSteel, soft}, mesh.cells, {}, {}, {}};
  const Eigen::VectorXd u =
      displaced(mesh.nodes, [](const Position& x) -> Position { return 1e-3 * x; });
  const auto found = fe::nodal_stress(mesh.nodes, cells, u, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_GT(found[0].nodes.size() + found[1].nodes.size(), static_cast<size_t>(mesh.nodes.rows()));
  const double pressure = 1e-3 * kSteel.youngs / (1.0 - 2.0 * kSteel.poisson);
  for (Eigen::Index k = 0; k < found[0].stress.rows(); ++k)
    EXPECT_NEAR(found[0].stress(k, 1), pressure, kExact * pressure);
  for (Eigen::Index k = 0; k < found[1].stress.rows(); ++k)
    EXPECT_NEAR(found[1].stress(k, 1), 0.5 * pressure, kExact * pressure);
}

TEST(VonMises, IsTheTensionOfABarRootThreeTimesAShearAndZeroUnderPressure) {
  EXPECT_DOUBLE_EQ(fe::von_mises((fe::Voigt() << 0, -7, 0, 0, 0, 0).finished()), 7.0);
  EXPECT_DOUBLE_EQ(fe::von_mises((fe::Voigt() << 0, 0, 0, 0, 2, 0).finished()),
                   2.0 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(fe::von_mises((fe::Voigt() << 5, 5, 5, 0, 0, 0).finished()), 0.0);
}

TEST(StressOfACell, IsRefusedWhenItIsInverted) {
  CellNodes x = reference(CellType::kHex8);
  x.row(0).swap(x.row(6));
  test::expect_parts(test::refusal_of([&] {
                       fe::point_stress(CellType::kHex8, fe::stress_points(CellType::kHex8), x,
                                        kSteel, Eigen::VectorXd::Zero(24), {});
                     }),
                     {"stress at (", "m: found det J = -", "expected > 0 (inverted cell)"});
}

}  // namespace
}  // namespace clatter::assembly::testing
