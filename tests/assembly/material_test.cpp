// SPDX-License-Identifier: GPL-3.0-or-later
// Materials from a file, thermal loads and lumped mass of an entire mesh.
#include "core/fe/material.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "assembly/load/thermal_load.hpp"
#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/fe/assemble.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

fe::Material parse(const std::string& text, const std::map<std::string, fe::Axes>& systems = {}) {
  const Config config = Config::parse(text, "m.toml");
  fe::MaterialTable table = fe::material_keys().read(config);
  fe::finish(keys::Source(config), table);
  fe::Material material = table.material;
  if (!table.system.empty()) material.axes = systems.at(table.system);
  return material;
}

std::string material_refusal(const std::string& text) {
  return test::refusal_of([&] { parse(text); });
}

TEST(Material, IsotropicConstantsInBothUnits) {
  EXPECT_DOUBLE_EQ(parse("E = 2.1e11\nnu = 0.3\nrho = 7800.0").youngs, 2.1e11);
  const fe::Material material = parse("E_gpa = 210\nnu = 0.3\nrho = 7800\nexpansion = 1.2e-5");
  EXPECT_DOUBLE_EQ(material.youngs, 2.1e11);
  EXPECT_TRUE(material.is_isotropic());
  EXPECT_EQ(material.expansion, 1.2e-5 * (fe::Voigt() << 1, 1, 1, 0, 0, 0).finished());
  EXPECT_EQ(material.integration.hex8, fe::Integration::kIncompatible);
}

TEST(Material, OrthotropicConstantsGiveTheComplianceBack) {
  const fe::Material material = parse(
      "E_gpa = [10, 20, 30]\nnu = [0.1, 0.2, 0.3]\nG_gpa = [1, 2, 3]\nrho = 1\nhex20 = 'reduced'");
  const fe::Elasticity S = material.elasticity->inverse();
  EXPECT_NEAR(S(0, 0) * 10e9, 1.0, 1e-14);
  EXPECT_NEAR(S(0, 1) * 10e9, -0.1, 1e-14);
  EXPECT_NEAR(S(2, 0) * 10e9, -0.2, 1e-14);
  EXPECT_NEAR(S(1, 2) * 20e9, -0.3, 1e-14);
  EXPECT_NEAR(S(3, 3) * 1e9, 1.0, 1e-14);  // 12
  EXPECT_NEAR(S(5, 5) * 2e9, 1.0, 1e-14);  // 13
  EXPECT_NEAR(S(4, 4) * 3e9, 1.0, 1e-14);  // 23
  EXPECT_EQ(material.integration.hex20, fe::Integration::kReduced);
}

TEST(Material, AnisotropicConstantsAreReadRowByRow) {
  const fe::Material material =
      parse("rho = 1\nC = [10, 1, 2, 0, 0, 0,  11, 3, 0, 0, 0,  12, 0, 0, 0,  4, 0, 0,  5, 0,  6]");
  const fe::Elasticity& C = *material.elasticity;
  EXPECT_EQ(C(0, 1), 1.0);
  EXPECT_EQ(C(2, 0), 2.0);
  EXPECT_EQ(C(1, 2), 3.0);
  EXPECT_EQ((C.diagonal()), (fe::Voigt() << 10, 11, 12, 4, 5, 6).finished());
}

TEST(Material, WhatHasNoPositiveEnergyIsRefused) {
  EXPECT_NE(material_refusal("E = 1.0\nnu = 0.5\nrho = 1").find("-1 < nu < 0.5"),
            std::string::npos);
  EXPECT_NE(material_refusal("E = -1.0\nnu = 0.3\nrho = 1").find("above 0"), std::string::npos);
  EXPECT_NE(material_refusal("E = [1, 1, 1]\nnu = [0.9, 0.9, 0.9]\nG = [1, 1, 1]\nrho = 1")
                .find("without positive elastic energy"),
            std::string::npos);
  EXPECT_NE(material_refusal("rho = 1\nC = [1, 2]").find("found 2 numbers, expected 21"),
            std::string::npos);
  EXPECT_EQ(material_refusal("E = 1.0\nE_gpa = 1.0\nnu = 0.3\nrho = 1"),
            "m.toml:2: E_gpa: E and E_gpa exclude each other");
  EXPECT_EQ(material_refusal("E = 1.0\nC = 2.0\nnu = 0.3\nrho = 1"),
            "m.toml:2: C: E and C exclude each other");
  EXPECT_EQ(material_refusal("E = 1.0\nrho = 1"), "m.toml:1: nu: is missing, E needs it");
}

TEST(Material, CylindricalAxesTurnWithThePlace) {
  // Stiff along the radius only: at (0, 1, 0) the radius is y.
  std::map<std::string, fe::Axes> ring = {{"ring", fe::Axes{}}};
  ring["ring"].kind = fe::Axes::Kind::kCylindrical;
  const fe::Material material =
      parse("E = [100, 1, 1]\nnu = [0, 0, 0]\nG = [1, 1, 1]\nrho = 1\nsystem = 'ring'", ring);
  EXPECT_NEAR(material.elasticity_at({2, 0, 5})(0, 0), 100.0, 1e-12);
  EXPECT_NEAR(material.elasticity_at({0, 2, 5})(1, 1), 100.0, 1e-12);
  EXPECT_NEAR(material.elasticity_at({0, 2, 5})(0, 0), 1.0, 1e-12);
}

/// A quarter of a ring that is stiff around its axis, moved by `shift`.
fe::NodalMatrices wound_ring(const Eigen::Vector3d& shift, fe::Axes::Kind kind) {
  BlockOptions options;
  options.type = mesh::CellType::kHex8;
  const Map map = ring(0.04, 0.06, 0.02);
  const mesh::Mesh mesh = block_mesh(
      {8, 2, 2},
      [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        return map({0.25 * x(0), x(1), x(2)}) + shift;
      },
      options);
  fe::Material material =
      parse("E_gpa = [10, 200, 10]\nnu = [0.02, 0.2, 0.3]\nG_gpa = [4, 4, 4]\nrho = 1600");
  material.axes = fe::Axes{kind, shift, Eigen::Matrix3d::Identity()};
  return fe::assemble(mesh, materials_of(mesh, material), fe::node_pattern(mesh));
}

// The directions are those at the place of each cell, wherever the part stands.
TEST(HardF2_MaterialAxes, APartIsAsStiffAtAnyPlace) {
  for (const auto kind : {fe::Axes::Kind::kCylindrical, fe::Axes::Kind::kSpherical}) {
    const SparseMatrix here = wound_ring(Eigen::Vector3d::Zero(), kind).K;
    const SparseMatrix away = wound_ring({0.7, -0.4, 1.1}, kind).K;
    EXPECT_LE((here - away).norm(), 1e-9 * here.norm());
  }
}

// u_r = c r stretches around by c and along the radius by c: hardly anything but the hoops resists.
TEST(HardF2_MaterialAxes, HoopsResistTheGrowthOfARing) {
  BlockOptions options;
  options.type = mesh::CellType::kHex20;
  options.curved = options.wrap_x = true;
  const mesh::Mesh mesh = block_mesh({16, 1, 1}, ring(0.04, 0.06, 0.02), options);
  fe::Material material =
      parse("E_gpa = [1, 200, 1]\nnu = [0.0, 0.0, 0.0]\nG_gpa = [1, 1, 1]\nrho = 1600");
  material.axes = fe::Axes{fe::Axes::Kind::kCylindrical, {}, Eigen::Matrix3d::Identity()};
  const SparseMatrix K = fe::assemble(mesh, materials_of(mesh, material), fe::node_pattern(mesh)).K;
  RowMatrix u = mesh.nodes;
  u.col(2).setZero();
  const Eigen::VectorXd motion = u.reshaped<Eigen::RowMajor>();
  const double volume = std::numbers::pi * (0.06 * 0.06 - 0.04 * 0.04) * 0.02;
  EXPECT_NEAR(motion.dot(multiply_symmetric(K, motion).col(0)) / (201e9 * volume), 1.0, 1e-3);
}

TEST(Assembly, AHeatedFreeBrickGrowsWithoutStress) {
  fe::Material material = kSteel;
  material.expansion.head<3>().setConstant(1.2e-5);
  const mesh::Mesh mesh = block_mesh({2, 2, 2}, brick({0.3, 0.2, 0.1}));
  const Eigen::VectorXd force =
      thermal_load(mesh, {material}, Eigen::VectorXd::Constant(mesh.nodes.rows(), 100.0));
  const fe::NodalMatrices matrices = fe::assemble(mesh, {material}, fe::node_pattern(mesh));
  Eigen::VectorXd u(3 * mesh.nodes.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    u.segment<3>(3 * a) = 1.2e-3 * mesh.nodes.row(a).transpose();
  const Eigen::VectorXd residue = multiply_symmetric(matrices.K, u) - force;
  EXPECT_LT(residue.norm(), 1e-12 * force.norm());
}

TEST(Assembly, LumpedMassHasTheTotalAndOneEntryAColumn) {
  const mesh::Mesh mesh = block_mesh({2, 1, 1}, brick({0.2, 0.1, 0.1}));
  const fe::NodePattern pattern = fe::node_pattern(mesh);
  const fe::NodalMatrices full = fe::assemble(mesh, materials_of(mesh), pattern);
  const fe::NodalMatrices lumped =
      fe::assemble(mesh, materials_of(mesh), pattern, fe::MassForm::kHrz);
  EXPECT_EQ(lumped.M.nonZeros(), lumped.M.cols());
  EXPECT_NEAR(lumped.M.sum(), 3.0 * 7800.0 * 0.2 * 0.1 * 0.1, 1e-10);
  EXPECT_EQ((lumped.K - full.K).norm(), 0.0);
}

}  // namespace
}  // namespace clatter::assembly::testing
