// SPDX-License-Identifier: GPL-3.0-or-later
// The parametric connecting rod against sums over its plan.
#include "mesh/geometry/rod_geometry.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh_toml.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

/// Thickness along x at a point of the plan, of a rod with the default dimensions and this web.
double rod_thickness(double y, double z, double web) {
  const RodParameters p;
  const double big = std::hypot(y, z), small = std::hypot(y, z - p.length);
  if (big < 0.5 * p.big_bore || small < 0.5 * p.small_bore) return 0.0;
  double thickness = 0.0;
  if (big < 0.5 * p.big_outer) thickness = std::max(thickness, p.big_width);
  if (small < 0.5 * p.small_outer) thickness = std::max(thickness, p.small_width);
  const double half = 0.5 * (p.shank_bottom + (p.shank_top - p.shank_bottom) * z / p.length);
  if (z > 0.0 && z < p.length && std::abs(y) < half) {
    const bool pocket = z > 0.5 * (p.big_outer + web) &&
                        z < p.length - 0.5 * (p.small_outer + web) && std::abs(y) < half - p.flange;
    thickness = std::max(thickness, pocket ? web : p.shank_thickness);
  }
  return thickness;
}

TEST(RodGeometry, VolumeAndBoresAreThoseOfItsPlan) {
  for (const double web : {8.0, 24.0}) {
    const Config config = Config::parse(
        fmt::format("name = 'rod'\nkind = 'rod'\n[rod]\nweb = {}\n", web), "rod.toml");
    GmshSession session("rod");
    const PartGeometry part = build_part(session, part_keys().read(config).shape);
    ASSERT_EQ(part.regions.size(), 1U);
    double volume = 0.0;
    constexpr double kStep = 0.05;  // [mm]: 2e-4 of the volume is at the edges of the plan
    for (double z = -54.0 + 0.5 * kStep; z < 240.0; z += kStep)
      for (double y = -54.0 + 0.5 * kStep; y < 54.0; y += kStep)
        volume += rod_thickness(y, z, web) * kStep * kStep;
    EXPECT_NEAR(session.volume(part.regions[0].solids), volume, 3e-4 * volume) << web;
    ASSERT_EQ(part.surfaces.size(), 2U);
    EXPECT_EQ(part.surfaces[0].name, "big_bore");
    EXPECT_EQ(part.surfaces[1].name, "small_bore");
  }
}

TEST(RodGeometry, ItsMeshHasItsBores) {
  const testing::Meshed meshed = testing::mesh_toml(
      "name = 'rod'\nkind = 'rod'\n[rod]\n[mesh]\nelement_size_mm = 14\nelements_per_turn = 24\n");
  const RodParameters p;
  for (const auto& [name, diameter, width] : {std::tuple{"big_bore", p.big_bore, p.big_width},
                                              {"small_bore", p.small_bore, p.small_width}}) {
    const double area = integrate(meshed.part.mesh, meshed.part.mesh.surfaces.at(name)).area;
    const double expected = std::numbers::pi * diameter * width * 1e-6;
    EXPECT_NEAR(area, expected, 1e-3 * expected) << name;
  }
}

TEST(RodGeometry, DimensionsThatDoNotFitAreRefusedByKey) {
  const auto refused = [](const std::string& key, double value) {
    const std::string said = test::refusal_of([&] {
      rod_keys().read(
          Config::parse(fmt::format("[rod]\n{} = {}\n", key, value), "rod.toml").table("rod"));
    });
    EXPECT_NE(said.find("rod." + key), std::string::npos) << said;
  };
  refused("big_bore", 108);
  refused("small_bore", 61);
  refused("length", 90);
  refused("shank_bottom", 110);
  refused("shank_top", 60);
  refused("shank_thickness", 30);
  refused("web", 25);
  refused("flange", 20);
  refused("big_width", -1);
}

}  // namespace
}  // namespace clatter::mesh
