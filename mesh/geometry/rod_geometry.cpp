// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/rod_geometry.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mesh/geometry/length_row.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

/// Ends of the pockets along the rod: half a web short of the eyes.
double pocket_begin(const RodParameters& p) { return 0.5 * p.big_outer + 0.5 * p.web; }
double pocket_end(const RodParameters& p) { return p.length - 0.5 * p.small_outer - 0.5 * p.web; }

bool has_pockets(const RodParameters& p) { return p.web < p.shank_thickness; }

/// Half the shank's width at a height.
double half_width(const RodParameters& p, double z) {
  return 0.5 * (p.shank_bottom + (p.shank_top - p.shank_bottom) * z / p.length);
}

void check_rod(const Config& t, const RodParameters& p) {
  const auto require = [&](bool holds, const char* key, const std::string& message) {
    if (!holds) t.fail(key, message);
  };
  require(p.big_bore < p.big_outer, "big_bore", "expected less than big_outer");
  require(p.small_bore < p.small_outer, "small_bore", "expected less than small_outer");
  require(pocket_begin(p) < pocket_end(p), "length",
          fmt::format("found {:g}, expected a shank between the eyes, which take {:g}", p.length,
                      0.5 * (p.big_outer + p.small_outer) + p.web));
  require(p.shank_bottom < p.big_outer, "shank_bottom", "expected less than big_outer");
  require(p.shank_top < p.small_outer, "shank_top", "expected less than small_outer");
  require(p.shank_thickness <= p.big_width && p.shank_thickness <= p.small_width, "shank_thickness",
          "expected at most big_width and small_width");
  require(p.web <= p.shank_thickness, "web", "expected at most shank_thickness");
  require(
      !has_pockets(p) || p.flange < half_width(p, pocket_end(p)), "flange",
      fmt::format("found {:g}, expected less than half the shank's width, {:g} at its narrow end",
                  p.flange, half_width(p, pocket_end(p))));
}

/// A trapezoid along the rod, symmetric in y, extruded along x.
Solid trapezoid(GmshSession& session, double x0, double x1, const Eigen::Vector2d& z,
                const Eigen::Vector2d& half) {
  return session.prism(
      {{x0, -half(0), z(0)}, {x0, half(0), z(0)}, {x0, half(1), z(1)}, {x0, -half(1), z(1)}},
      {x1 - x0, 0.0, 0.0});
}

Solid eye(GmshSession& session, double z, double diameter, double width) {
  return session.cylinder({-0.5 * width, 0.0, z}, {width, 0.0, 0.0}, 0.5 * diameter);
}

Solid build_solid(GmshSession& s, const RodParameters& p) {
  const double x = 0.5 * p.shank_thickness;
  const Solid shank =
      trapezoid(s, -x, x, {0.0, p.length}, {half_width(p, 0.0), half_width(p, p.length)});
  Solid rod = require_one(s.fuse({shank}, {eye(s, 0.0, p.big_outer, p.big_width),
                                           eye(s, p.length, p.small_outer, p.small_width)}),
                          "rod: eyes");
  const double beyond = std::max(p.big_width, p.small_width);
  Solids tools{eye(s, 0.0, p.big_bore, 2.0 * beyond), eye(s, p.length, p.small_bore, 2.0 * beyond)};
  if (has_pockets(p)) {
    const Eigen::Vector2d z(pocket_begin(p), pocket_end(p));
    const Eigen::Vector2d half(half_width(p, z(0)) - p.flange, half_width(p, z(1)) - p.flange);
    tools.push_back(trapezoid(s, 0.5 * p.web, beyond, z, half));
    tools.push_back(trapezoid(s, -beyond, -0.5 * p.web, z, half));
  }
  return require_one(s.cut({rod}, tools), "rod: bores and pockets");
}

NamedSurface bore(const std::string& name, double z, double diameter) {
  SurfaceFilter filter;
  filter.cylinder = CylinderFilter{0.5 * diameter, {0.0, 0.0, z}, Vector3d::UnitX()};
  return {name, {filter}};
}

}  // namespace

const keys::Keys<RodParameters>& rod_keys() {
  static const keys::Keys<RodParameters> keys(
      "rod", "a connecting rod", [](auto& key, RodParameters& p) {
        length(key, "length", p.length, "distance of the centres of the eyes");
        length(key, "big_bore", p.big_bore, "diameter of the big end's bore");
        length(key, "big_outer", p.big_outer, "outer diameter of the big end");
        length(key, "big_width", p.big_width, "width of the big end along the crankshaft");
        length(key, "small_bore", p.small_bore, "diameter of the small end's bore");
        length(key, "small_outer", p.small_outer, "outer diameter of the small end");
        length(key, "small_width", p.small_width, "width of the small end along the crankshaft");
        length(key, "shank_bottom", p.shank_bottom, "width of the shank at the big end");
        length(key, "shank_top", p.shank_top, "width of the shank at the small end");
        length(key, "shank_thickness", p.shank_thickness,
               "thickness of the shank along the crankshaft");
        length(key, "flange", p.flange, "width of the flanges beside the pockets");
        length(key, "web", p.web, "thickness between the pockets; shank_thickness for none");
        key.check(check_rod);
      });
  return keys;
}

PartGeometry build_rod(GmshSession& session, const RodParameters& p) {
  PartGeometry part;
  part.regions = {{"rod", {build_solid(session, p)}}};
  part.surfaces = {bore("big_bore", 0.0, p.big_bore), bore("small_bore", p.length, p.small_bore)};
  return part;
}

}  // namespace clatter::mesh
