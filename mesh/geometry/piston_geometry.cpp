// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/piston_geometry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "mesh/geometry/length_row.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

void check_piston(const Config& t, const PistonParameters& p) {
  const auto require = [&](bool holds, const char* key, const std::string& message) {
    if (!holds) t.fail(key, message);
  };
  const double radius = 0.5 * p.diameter;
  require(p.land_heights.size() == p.groove_heights.size() + 1, "land_heights",
          fmt::format("found {} lands and {} grooves, expected one land more than grooves",
                      p.land_heights.size(), p.groove_heights.size()));
  require(p.bowl_diameter < p.diameter, "bowl_diameter", "expected less than diameter");
  require(p.groove_depth < p.belt_wall, "groove_depth", "expected less than belt_wall");
  require(p.belt_wall < radius, "belt_wall", "expected less than half the diameter");
  require(p.belt_bottom() < p.under_crown(), "crown_thickness",
          fmt::format("the belt ends at z = {}, expected below the crown's underside at {}",
                      p.belt_bottom(), p.under_crown()));
  require(p.belt_bottom() > 0.5 * p.boss_diameter, "boss_diameter",
          fmt::format("expected the bosses below the belt's lower end at z = {}", p.belt_bottom()));
  require(p.boss_diameter > p.pin_diameter, "boss_diameter", "expected more than pin_diameter");
  require(p.skirt_depth > 0.5 * p.boss_diameter, "skirt_depth",
          "expected the skirt to end below the bosses");
  require(p.panel_distance < radius - p.skirt_wall, "panel_distance",
          "expected inside the skirt's inner radius");
  require(0.5 * p.boss_gap < p.panel_distance - p.panel_wall, "boss_gap",
          "expected the bosses to reach inside the panels");
  require(p.pillar_width < p.boss_diameter, "pillar_width", "expected less than boss_diameter");
  require(std::hypot(radius - p.belt_wall, 0.5 * p.pillar_width) < radius - p.groove_depth,
          "pillar_width", "expected the pillars to end short of the grooves");
  require(std::abs(p.pin_offset) < 0.1 * p.diameter, "pin_offset", "expected a small offset");
}

/// Builds one piston; every vertical cylinder is on the piston's axis, not the pin's.
class PistonBuilder {
 public:
  PistonBuilder(GmshSession& session, const PistonParameters& p) : s_(session), p_(p) {}

  // Upper and lower part share the plane at the belt's lower end, so that the skirt is one face.
  Solids build() {
    Solid body = require_one(s_.cut({blank()}, hollows()), "piston: hollows");
    body = require_one(s_.fuse({body}, bosses()), "piston: bosses");
    const double x = p_.panel_distance + p_.diameter;
    const Solid pin = s_.cylinder({-x, 0, 0}, {2 * x, 0, 0}, 0.5 * p_.pin_diameter);
    body = require_one(s_.cut({body}, {pin}), "piston: pin bore");
    const Solids twin = s_.copy({body});
    const Solids upper = s_.cut({body}, {below_belt()});
    const Solids lower = s_.intersect(twin, {below_belt()});
    Solids halves = upper;
    halves.insert(halves.end(), lower.begin(), lower.end());
    Solids all;
    for (const Solids& piece : s_.fragment(halves))
      all.insert(all.end(), piece.begin(), piece.end());
    return all;
  }

 private:
  double radius() const { return 0.5 * p_.diameter; }
  double axis_y() const { return -p_.pin_offset; }
  double far() const { return 2.0 * p_.diameter; }

  Solid upright(double r, double z0, double z1) {
    return s_.cylinder({0, axis_y(), z0}, {0, 0, z1 - z0}, r);
  }
  Solid below_belt() {
    return s_.box({-far(), -far(), -p_.skirt_depth - 1.0}, {far(), far(), p_.belt_bottom()});
  }

  // Full cylinder, below the belt cut away outside the panels.
  Solid blank() {
    const Solid full = upright(radius(), -p_.skirt_depth, p_.compression_height);
    Solids windows;
    for (double side : {-1.0, 1.0}) {
      const double a = side * p_.panel_distance, b = side * far();
      windows.push_back(s_.box({std::min(a, b), -far(), -p_.skirt_depth - 1.0},
                               {std::max(a, b), far(), p_.belt_bottom()}));
    }
    return require_one(s_.cut({full}, windows), "piston: windows");
  }

  Solids hollows() {
    const double top = p_.compression_height, low = -p_.skirt_depth - 1.0;
    Solids tools = {upright(0.5 * p_.bowl_diameter, top - p_.bowl_depth, top + 1.0)};
    double z = top;
    for (size_t g = 0; g < p_.groove_heights.size(); ++g) {
      z -= p_.land_heights[g];
      const double height = p_.groove_heights[g];
      const Solid ring = upright(radius() + 1.0, z - height, z);
      const Solid core = upright(radius() - p_.groove_depth, z - height, z);
      tools.push_back(require_one(s_.cut({ring}, {core}), "piston: groove"));
      z -= height;
    }
    tools.push_back(upright(radius() - p_.belt_wall, p_.belt_bottom(), p_.under_crown()));
    const double inside = p_.panel_distance - p_.panel_wall;
    const Solid room = upright(radius() - p_.skirt_wall, low, p_.belt_bottom());
    const Solid slab = s_.box({-inside, -far(), low}, {inside, far(), p_.belt_bottom()});
    tools.push_back(require_one(s_.intersect({room}, {slab}), "piston: skirt room"));
    return tools;
  }

  Solid slab(double side, double inner, double outer, double z0, double z1) {
    const double a = side * inner, b = side * outer, w = 0.5 * p_.pillar_width;
    return s_.box({std::min(a, b), -w, z0}, {std::max(a, b), w, z1});
  }

  // Bosses around the pin, and pillars that connect them to the crown; above the belt's lower end
  // the pillars extend into the belt's wall, short of the grooves.
  Solids bosses() {
    const double inner = 0.5 * p_.boss_gap, outer = p_.panel_distance;
    const double groove =
        std::sqrt(std::pow(radius() - p_.groove_depth, 2) - std::pow(0.5 * p_.pillar_width, 2));
    const double reach = 0.5 * (radius() - p_.belt_wall + groove);
    const double top = p_.under_crown() + 0.5 * p_.crown_thickness;
    Solids result;
    for (double side : {-1.0, 1.0}) {
      result.push_back(s_.cylinder({side * inner, 0, 0}, {side * (outer - inner), 0, 0},
                                   0.5 * p_.boss_diameter));
      result.push_back(slab(side, inner, outer, 0.0, p_.belt_bottom()));
      result.push_back(slab(side, inner, reach, p_.belt_bottom(), top));
    }
    return result;
  }

  GmshSession& s_;
  const PistonParameters& p_;
};

std::vector<NamedSurface> piston_surfaces(const PistonParameters& p) {
  constexpr double kFar = 1e9;
  const Vector3d on_axis(0.0, -p.pin_offset, 0.0);
  SurfaceFilter rim, floor, wall, skirt, pin;
  rim.plane = PlaneFilter{Vector3d::UnitZ(), p.compression_height};
  floor.plane = PlaneFilter{Vector3d::UnitZ(), p.compression_height - p.bowl_depth};
  wall.cylinder = CylinderFilter{0.5 * p.bowl_diameter, on_axis, Vector3d::UnitZ()};
  skirt.cylinder = CylinderFilter{0.5 * p.diameter, on_axis, Vector3d::UnitZ()};
  skirt.box = BoxFilter{{-kFar, -kFar, -kFar}, {kFar, kFar, p.belt_bottom()}};
  pin.cylinder = CylinderFilter{0.5 * p.pin_diameter, Vector3d::Zero(), Vector3d::UnitX()};
  return {{"crown", {rim, floor, wall}}, {"skirt", {skirt}}, {"pin_bore", {pin}}};
}

}  // namespace

double PistonParameters::belt_bottom() const {
  const double lands = std::accumulate(land_heights.begin(), land_heights.end(), 0.0);
  const double grooves = std::accumulate(groove_heights.begin(), groove_heights.end(), 0.0);
  return compression_height - lands - grooves;
}

const keys::Keys<PistonParameters>& piston_keys() {
  static const keys::Keys<PistonParameters> keys(
      "piston", "an aluminium piston", [](auto& key, PistonParameters& p) {
        length(key, "diameter", p.diameter, "diameter of the piston, without barrel and clearance");
        length(key, "compression_height", p.compression_height,
               "distance from the pin to the crown");
        length(key, "skirt_depth", p.skirt_depth, "distance from the pin to the skirt's lower end");
        key.number("pin_offset", p.pin_offset, {}, "offset of the pin toward the thrust side")
            .shown_in("length_unit");
        length(key, "bowl_diameter", p.bowl_diameter, "diameter of the bowl in the crown");
        length(key, "bowl_depth", p.bowl_depth, "depth of the bowl");
        length(key, "crown_thickness", p.crown_thickness, "thickness of the crown under the bowl");
        length(key, "belt_wall", p.belt_wall,
               "thickness of the ring belt, inside the outer diameter");
        length(key, "groove_depth", p.groove_depth, "depth of the ring grooves");
        key.numbers("land_heights", p.land_heights, Range::positive(),
                    "heights of the lands, from the crown down")
            .shown_in("length_unit");
        key.numbers("groove_heights", p.groove_heights, Range::positive(),
                    "heights of the grooves between the lands")
            .shown_in("length_unit");
        length(key, "skirt_wall", p.skirt_wall, "thickness of the skirt");
        length(key, "panel_distance", p.panel_distance,
               "distance from the middle to the outer side of the panels");
        length(key, "panel_wall", p.panel_wall, "thickness of the panels between skirt and bosses");
        length(key, "pin_diameter", p.pin_diameter, "diameter of the pin bore");
        length(key, "boss_diameter", p.boss_diameter, "diameter of the pin bosses");
        length(key, "boss_gap", p.boss_gap, "distance between the bosses, where the rod is");
        length(key, "pillar_width", p.pillar_width,
               "width of the pillars between bosses and crown");
        key.check(check_piston);
      });
  return keys;
}

PartGeometry build_piston(GmshSession& session, const PistonParameters& p) {
  PartGeometry part;
  part.regions = {{"piston", PistonBuilder(session, p).build()}};
  part.surfaces = piston_surfaces(p);
  return part;
}

}  // namespace clatter::mesh
