// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets of layers in a model.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "block_mesh.hpp"
#include "core/base/log.hpp"
#include "modal/statics.hpp"
#include "sheet.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::modal {
namespace {

using assembly::testing::build_all;
using assembly::testing::sheet;
using test::refusal_of;
using ::testing::HasSubstr;

constexpr double kLong = 0.4, kWide = 0.05;

/// Two metals, and fibres along direction 1.
const std::string kMaterials =
    "[material.iron]\nE = 2e11\nnu = 0.3\nrho = 8000.0\nexpansion = 1.2e-5\n"
    "[material.brass]\nE = 1e11\nnu = 0.3\nrho = 8500.0\nexpansion = 1.9e-5\n"
    "[material.fibres]\nE = [1.4e11, 1e10, 1e10]\nnu = [0.3, 0.3, 0.4]\nG = [5e9, 5e9, 3e9]\n"
    "rho = 1600.0\nexpansion = [-1e-6, 3e-5, 3e-5]\n"
    "[system.along]\norigin = [0.0, 0.0, 0.0]\nz = [0.0, 0.0, 1.0]\nx = [1.0, 0.0, 0.0]\n";

std::string layer(const std::string& material, double thickness, double angle = 0.0) {
  return fmt::format("[[shell.layer]]\nmaterial = \"{}\"\nthickness = {}\nangle_deg = {:.1f}\n",
                     material, thickness, angle);
}

std::string shell(const std::string& more) {
  return kMaterials + "[[shell]]\nregions = [\"sheet\"]\n" + more;
}

/// Free in its plane and to bend.
const std::string kHeldAsABody =
    "[[support]]\nname = \"wall\"\nnode_set = \"tip\"\n"
    "directions = [\"x\", \"y\", \"z\", \"rx\", \"ry\", \"rz\"]\n";

TEST(LaminateModel, OfTwoMetalsBendsToASphereAndHasNoForces) {
  const std::string warm = "[[load]]\nname = \"warm\"\nkind = \"temperature\"\nvalue = 50.0\n";
  const double inner = 0.0006, outer = 0.001, h = inner + outer;
  const auto model =
      build_all(sheet(kLong, kWide, 8, 2),
                shell(layer("iron", inner) + layer("brass", outer) + kHeldAsABody + warm))
          .model;
  const StaticCase found = solve_static(model, {}).cases.at(0);
  const double m = inner / outer, n = 2.0, more = (1.0 + m) * (1.0 + m);
  const double bend =
      50.0 * 6.0 * 0.7e-5 * more / (h * (3.0 * more + (1.0 + m * n) * (m * m + 1.0 / (m * n))));
  // The brass outside grows more: the sheet bends down from the tip.
  for (int i = 0; i < 9; ++i) {
    const double x = kLong * i / 8.0 - kLong, y = -0.5 * kWide;
    EXPECT_NEAR(found.displacement(3 * i + 2), -0.5 * bend * (x * x + y * y), 1e-9 * bend) << i;
  }
  EXPECT_LE(found.support_sums.cwiseAbs().maxCoeff(), 1e-7);
  // Free bars of two metals: E (e + z k - a dT) at the faces, e and k of the section.
  const fe::ShellStiffness s = fe::stiffness_of(model.cells.sections[0], {}, h);
  const auto face = [&](double E, double grows, double z) {
    return E / 0.7 * 50.0 * (s.stretch(0) + z * s.curl(0) - grows);
  };
  const double outside = face(1e11, 1.9e-5, 0.5 * h), inside = face(2e11, 1.2e-5, -0.5 * h);
  EXPECT_LT(outside * inside, 0.0);
  EXPECT_NEAR(found.stress[0].stress(4, 0), outside, 1e-6 * std::abs(outside));
  EXPECT_NEAR(found.stress[0].stress(4, 1), outside, 1e-6 * std::abs(outside));
  EXPECT_NEAR(found.stress[1].stress(4, 0), inside, 1e-6 * std::abs(inside));
}

TEST(LaminateModel, PullsOutOfItsPlaneAndTwistsByItsAngles) {
  // Clamped at x0, pulled at x1. Unsymmetric fibres at +-45 degrees twist; the plate's solution
  // with free curvature is e = a N, k = b' N.
  const std::string pull =
      "[[point]]\nname = \"end\"\nnode_set = \"tip\"\n"
      "[[load]]\nname = \"warm\"\nkind = \"temperature\"\nvalue = 10.0\n";
  const auto twist = [&](double first) {
    const auto model = build_all(sheet(kLong, kWide, 8, 2),
                                 shell("system = \"along\"\n" + layer("fibres", 0.001, first) +
                                       layer("fibres", 0.001, -first) + kHeldAsABody + pull))
                           .model;
    const StaticCase found = solve_static(model, {}).cases.at(0);
    // w = -k12/2 x y from the tip: at the corner (0, 0).
    const fe::ShellStiffness s = fe::stiffness_of(model.cells.sections[0], {}, 0.002);
    EXPECT_NEAR(found.displacement(2), -0.5 * 10.0 * s.curl(2) * (-kLong) * (-0.5 * kWide),
                1e-7 * std::abs(s.curl(2)));
    return s.curl(2);
  };
  EXPECT_NEAR(twist(45.0), -twist(-45.0), 1e-12);
  EXPECT_GT(std::abs(twist(45.0)), 1e-4);
}

TEST(LaminateModel, WeighsAsItsLayers) {
  const auto model = build_all(sheet(kLong, kWide, 4, 2),
                               shell("offset = 0.01\nsystem = \"along\"\n" + layer("iron", 0.002) +
                                     layer("fibres", 0.004) + layer("brass", 0.001)))
                         .model;
  const double area = 16.0 + 6.4 + 8.5;
  const double moment = -16.0 * 0.0025 + 6.4 * 0.0005 + 8.5 * 0.003;
  const auto own = [](double mass, double t, double z) { return mass * (t * t / 12.0 + z * z); };
  const double second =
      own(16.0, 0.002, -0.0025) + own(6.4, 0.004, 0.0005) + own(8.5, 0.001, 0.003);
  const double m = area * kLong * kWide, z = moment / area;
  EXPECT_NEAR(model.mass.mass, m, 1e-12 * m);
  EXPECT_NEAR(model.mass.centre(2), 0.01 + z, 1e-12);
  const double about_x = m * (kWide * kWide / 12.0 + second / area - z * z);
  EXPECT_NEAR(model.mass.inertia(0, 0), about_x, 1e-12 * about_x);
}

TEST(LaminateModel, LayersThatAreNotAsThickAsTheMeshAreSaid) {
  mesh::Mesh mesh = sheet(kLong, kWide, 2, 2);
  mesh.shells[0].thickness = RowMatrix::Constant(4, 4, 0.0015);
  std::string said;
  set_log_sink([&](bool, const std::string& text) { said += text; });
  const auto model = build_all(mesh, shell(layer("iron", 0.001))).model;
  set_log_sink({});
  EXPECT_THAT(said, HasSubstr("its layers are 0.001 m thick, the mesh has 0.0015 to 0.0015 m"));
  const double m = 8000.0 * 0.0015 * kLong * kWide;
  EXPECT_NEAR(model.mass.mass, m, 1e-12 * m);
}

TEST(LaminateModel, WhatItNeedsIsSaid) {
  const auto of = [](const std::string& toml) {
    return refusal_of([&] { build_all(sheet(kLong, kWide, 4, 2), toml); });
  };
  EXPECT_THAT(of(shell(layer("gold", 0.001))),
              HasSubstr("material: found \"gold\", expected one of"));
  EXPECT_THAT(of(shell(layer("fibres", 0.001))),
              HasSubstr("found no direction 1 of the sheet of region \"sheet\""));
  EXPECT_THAT(of(shell("thickness = 0.002\n" + layer("iron", 0.001))),
              HasSubstr("it is that of the layers"));
  EXPECT_THAT(of(shell("[[shell.layer]]\nmaterial = \"iron\"\n")), HasSubstr("thickness"));
  EXPECT_THAT(of(shell("system = \"along\"\nthickness = 0.002\n")),
              HasSubstr("found none for region \"sheet\""));
  const std::string across =
      "[system.across]\norigin = [0.0, 0.0, 0.0]\nz = [1.0, 0.0, 0.0]\nx = [0.0, 0.0, 1.0]\n";
  EXPECT_THAT(of(across + shell("system = \"across\"\n" + layer("fibres", 0.001))),
              HasSubstr("direction 1 of its material is along its normal"));
  EXPECT_THAT(of("[material.turned]\nregions = [\"sheet\"]\nE = [1e11, 1e10, 1e10]\n"
                 "nu = [0.3, 0.3, 0.4]\nG = [5e9, 5e9, 3e9]\nrho = 1600.0\nsystem = \"along\"\n" +
                 shell("thickness = 0.002\n")),
              HasSubstr("which has a system: that of [[shell]] turns the materials of sheets"));
}

}  // namespace
}  // namespace clatter::modal
