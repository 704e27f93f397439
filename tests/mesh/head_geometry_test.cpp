// SPDX-License-Identifier: GPL-3.0-or-later
// The parametric cylinder head against sums over its plan.
#include "mesh/geometry/head_geometry.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh_toml.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

constexpr double kPi = std::numbers::pi;

/// Material above a point of the plan of the default head [mm].
double height_of_material(double x, double y) {
  const HeadParameters p;
  double height = p.height;
  if (std::abs(x) < 0.5 * p.length - p.wall && std::abs(y) < 0.5 * p.width - p.wall) {
    height -= p.height - p.deck_top();
    for (int k = 0; k <= p.cylinders; ++k)
      if (std::hypot(x - p.x_of_bolt(k), std::abs(y) - p.bolt_reach) < 0.5 * p.seat)
        height += p.seat_height;
  }
  for (int i = 0; i < p.cylinders; ++i) {
    const double dx = x - p.x_of_cylinder(i);
    if (std::hypot(dx, y) < 0.5 * p.bore) height -= p.recess;
    if (std::abs(dx) < 0.5 * (p.cylinder_pitch - p.bulkhead) &&
        std::abs(y) < 0.5 * p.width - p.wall && std::hypot(dx, y) > 0.5 * p.tower)
      height -= p.jacket;
  }
  return height;
}

TEST(HeadGeometry, VolumeIsThatOfItsPlan) {
  const Config config = Config::parse("name = 'head'\nkind = 'head'\n[head]\n", "head.toml");
  GmshSession session("head");
  const PartGeometry part = build_part(session, part_keys().read(config).shape);
  ASSERT_EQ(part.regions.size(), 1U);
  const HeadParameters p;
  constexpr double kStep = 0.25;  // [mm]
  double volume = 0.0;
  for (double x = -0.5 * p.length + 0.5 * kStep; x < 0.5 * p.length; x += kStep)
    for (double y = -0.5 * p.width + 0.5 * kStep; y < 0.5 * p.width; y += kStep)
      volume += height_of_material(x, y) * kStep * kStep;
  EXPECT_NEAR(session.volume(part.regions[0].solids), volume, 3e-4 * volume);
}

TEST(HeadGeometry, ItsMeshHasDeckRoofsSeatsAndFlange) {
  const testing::Meshed meshed = testing::mesh_toml(
      "name = 'head'\nkind = 'head'\n[head]\n[mesh]\nelement_size_mm = 30\n"
      "elements_per_turn = 16\n");
  const HeadParameters p;
  const auto area = [&](const std::string& name) {
    return 1e6 * integrate(meshed.part.mesh, meshed.part.mesh.surfaces.at(name)).area;
  };
  const double bore = 0.25 * kPi * p.bore * p.bore, whole = p.length * p.width;
  double roofs = 0.0;
  for (int i = 1; i <= p.cylinders; ++i) {
    const double roof = area(fmt::format("roof_{}", i));
    EXPECT_NEAR(roof, bore, 1e-3 * bore) << i;
    roofs += roof;
  }
  EXPECT_NEAR(area("fire_deck") + roofs, whole, 1e-9 * whole);
  const double hole = (p.length - 2.0 * p.wall) * (p.width - 2.0 * p.wall);
  EXPECT_NEAR(area("cover_flange"), whole - hole, 1e-9 * whole);
  EXPECT_NEAR(area("outer"), 2.0 * (p.length + p.width) * p.height, 1e-9 * whole);
  // The inner seats end at the wall beside them.
  const double r = 0.5 * p.seat, to_wall = 0.5 * p.width - p.wall - p.bolt_reach;
  const double beyond =
      r * r * std::acos(to_wall / r) - to_wall * std::sqrt(r * r - to_wall * to_wall);
  EXPECT_NEAR(area("bolt_3"), kPi * r * r - beyond, 2e-3 * kPi * r * r);
  EXPECT_NEAR(area("bolt_4"), area("bolt_3"), 1e-3 * kPi * r * r);
  EXPECT_LT(area("bolt_1"), 0.95 * area("bolt_3"));
}

TEST(HeadGeometry, DimensionsThatDoNotFitAreRefusedByKey) {
  const auto refused = [](const std::string& key, double value) {
    const std::string said = test::refusal_of([&] {
      head_keys().read(
          Config::parse(fmt::format("[head]\n{} = {}\n", key, value), "head.toml").table("head"));
    });
    EXPECT_NE(said.find("head." + key), std::string::npos) << said;
  };
  refused("bore", 130);
  refused("length", 490);
  refused("wall", 61);
  refused("tower", 111);
  refused("recess", 14);
  refused("height", 70);
  refused("bolt_reach", 69);
  refused("seat", 25.5);
  refused("jacket", 0);
}

}  // namespace
}  // namespace clatter::mesh
