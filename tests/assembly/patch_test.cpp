// SPDX-License-Identifier: GPL-3.0-or-later
// Patch tests: fields that the elements can represent come out exactly on distorted meshes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "assembly/surface/surface_integral.hpp"
#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/fe/assemble.hpp"
#include "one_cell.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

const Eigen::Vector3d kSize(1.0, 0.8, 1.2);
constexpr std::array<int, 3> kCells = {2, 2, 2};

/// A displacement field with its (constant) body force.
struct Field {
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> u;
  Eigen::Vector3d body = Eigen::Vector3d::Zero();  // - div sigma [N/m3]
};

Field linear_field() {
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.3, -0.2, 0.5, -0.7, 0.4, 0.1, 0.6, 0.9;
  return {[=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
            return 1e-3 * (gradient * x + Eigen::Vector3d(0.1, 0.2, 0.3));
          },
          Eigen::Vector3d::Zero()};
}

/// u = (x^2 + y z, y^2 + z x, z^2 + x y): div u = 2 (x + y + z), laplacian u = (2, 2, 2), so
/// - div sigma = -(lambda + mu) (2, 2, 2) - mu (2, 2, 2).
Field quadratic_field() {
  const double b = -2.0 * (kSteel.lambda() + 2.0 * kSteel.mu());
  return {[](const Eigen::Vector3d& x) -> Eigen::Vector3d {
            return 1e-3 * Eigen::Vector3d(x(0) * x(0) + x(1) * x(2), x(1) * x(1) + x(2) * x(0),
                                          x(2) * x(2) + x(0) * x(1));
          },
          1e-3 * Eigen::Vector3d::Constant(b)};
}

/// Holds the boundary at the field, solves inside; returns the largest error over the largest u.
double patch_error(const mesh::Mesh& mesh, const Field& field,
                   const fe::Material& material = kSteel) {
  const fe::NodePattern pattern = fe::node_pattern(mesh);
  fe::NodalMatrices matrices = fe::assemble(mesh, materials_of(mesh, material), pattern);
  const Eigen::Index n = 3 * mesh.nodes.rows();
  Eigen::VectorXd exact(n), body(n);
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
    exact.segment<3>(3 * a) = field.u(mesh.nodes.row(a).transpose());
    body.segment<3>(3 * a) = field.body / kSteel.density;
  }
  std::vector<bool> fixed(static_cast<size_t>(n), false);
  for (const int32_t node : mesh::nodes_of(mesh.surface("skin")))
    for (int d = 0; d < 3; ++d) fixed[3 * node + d] = true;
  // A constant body force is M times a constant acceleration.
  const Eigen::VectorXd f = multiply_symmetric(matrices.M, body);
  const Eigen::VectorXd u = solve_fixed(matrices.K, f, fixed, exact);
  return (u - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

mesh::Mesh shaken(mesh::CellType type) {
  BlockOptions options;
  options.type = type;
  return block_mesh(kCells, shaken_brick(kSize, kCells, 0.2), options);
}

/// A parallelepiped of cells with parallel edges.
mesh::Mesh sheared(mesh::CellType type) {
  BlockOptions options;
  options.type = type;
  return block_mesh(
      kCells,
      [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        return {x(0) + 0.3 * x(1), 0.8 * x(1) - 0.1 * x(2), 1.2 * x(2) + 0.2 * x(0)};
      },
      options);
}

/// A brick whose inside is bent, so that mid-side nodes leave their edges; sides stay flat.
mesh::Mesh bent_inside(mesh::CellType type) {
  BlockOptions options;
  options.type = type;
  options.curved = true;
  return block_mesh(
      kCells,
      [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        const double pi = std::numbers::pi;
        const double bump = 0.06 * std::sin(pi * x(0)) * std::sin(pi * x(1)) * std::sin(pi * x(2));
        return (x + bump * Eigen::Vector3d(1.0, -0.7, 0.5)).cwiseProduct(kSize);
      },
      options);
}

using mesh::CellType;

class PatchCell : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(PatchTest, PatchCell, ::testing::ValuesIn(kAllCells),
                         [](const auto& info) {
                           return std::string(mesh::traits(info.param).name);
                         });

TEST_P(PatchCell, LinearFieldIsExactOnADistortedMesh) {
  EXPECT_LT(patch_error(shaken(GetParam()), linear_field()), 1e-12);
}

TEST_P(PatchCell, LinearFieldIsExactWithReducedAndFullIntegration) {
  fe::Material material = kSteel;
  material.integration = {fe::Integration::kFull, fe::Integration::kReduced,
                          fe::Integration::kReduced, fe::Integration::kReduced};
  EXPECT_LT(patch_error(shaken(GetParam()), linear_field(), material), 1e-11);
}

class QuadraticCell : public PatchCell {};
INSTANTIATE_TEST_SUITE_P(PatchTest, QuadraticCell,
                         ::testing::Values(CellType::kTet10, CellType::kHex20, CellType::kWedge15,
                                           CellType::kPyramid13),
                         [](const auto& info) {
                           return std::string(mesh::traits(info.param).name);
                         });

TEST_P(QuadraticCell, LinearFieldIsExactOnACurvedMesh) {
  EXPECT_LT(patch_error(bent_inside(GetParam()), linear_field()), 1e-12);
}

/// Cells with parallel edges, where the functions contain every quadratic polynomial of x.
TEST_P(QuadraticCell, HardG3_QuadraticFieldIsExactOnStraightQuadraticCells) {
  const bool tet = mesh::traits(GetParam()).corners == 4;
  EXPECT_LT(patch_error(tet ? shaken(GetParam()) : sheared(GetParam()), quadratic_field()), 1e-12);
}

TEST(PatchTest, HardG3_QuadraticFieldShowsSwappedMiddleNodes) {
  // The order of other programs in our reader: the test must detect it. With straight cells the
  // swap moves two mid-side nodes, so det J is not positive or the field is off.
  mesh::Mesh mesh = shaken(mesh::CellType::kTet10);
  mesh.cells[0].nodes.col(8).swap(mesh.cells[0].nodes.col(9));
  try {
    EXPECT_GT(patch_error(mesh, quadratic_field()), 1e-3);
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("det J"), std::string::npos);
  }
}

TEST(PatchTest, EnergyOfAQuadraticFieldIsExact) {
  // u = (x^2, 0, 0) on a brick a x b x c: 1/2 (lambda + 2 mu) int (2 x)^2 = (2/3) (..) a^3 b c.
  const mesh::Mesh mesh = shaken(mesh::CellType::kTet10);
  const fe::NodalMatrices matrices = fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh));
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    u(3 * a) = mesh.nodes(a, 0) * mesh.nodes(a, 0);
  const double energy = 0.5 * u.dot(multiply_symmetric(matrices.K, u).col(0));
  const double exact = 2.0 / 3.0 * (kSteel.lambda() + 2.0 * kSteel.mu()) * std::pow(kSize(0), 3) *
                       kSize(1) * kSize(2);
  EXPECT_NEAR(energy / exact, 1.0, 1e-13);
}

}  // namespace
}  // namespace clatter::assembly::testing
