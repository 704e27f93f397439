// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/block_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/geometry/length_row.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

// --- reading -------------------------------------------------------------------------------------

void require(const Config& table, bool holds, const char* key, const std::string& message) {
  if (!holds) table.fail(key, message);
}

void check_block(const Config& t, const BlockParameters& p) {
  const double apart = p.parent_bores ? p.bore : 2.0 * p.liner_radius();
  require(t, p.cylinder_pitch > apart, "cylinder_pitch",
          fmt::format("found {}, expected more than the {} {}", p.cylinder_pitch,
                      p.parent_bores ? "bore" : "liners' outer diameter", apart));
  const double free_wall = p.parent_bores ? 0.4 * p.cylinder_pitch : p.cylinder_pitch - p.bore;
  require(t, p.bearing_wall < free_wall, "bearing_wall",
          fmt::format("found {}, expected less than {} = {}: the {}", p.bearing_wall,
                      p.parent_bores ? "0.4 pitch" : "pitch - bore", free_wall,
                      p.parent_bores ? "crank's webs pass" : "piston passes"));
  require(t, !p.has_relief() || 2.0 * p.relief_radius() < p.cylinder_pitch, "bearing_wall",
          fmt::format("found {}, expected less than pitch - bore = {}: a pitch below {} leaves no "
                      "wall where the pistons pass",
                      p.bearing_wall, p.cylinder_pitch - p.bore, 2.0 * p.relief_radius()));
  require(t, !p.has_relief() || 0.5 * p.bearing_boss < p.relief_bottom(), "bearing_boss",
          fmt::format("found {}, expected less than {}: the piston passes", p.bearing_boss,
                      2.0 * p.relief_bottom()));
  require(t, p.deck_height > 0.5 * p.stroke + p.rod_length, "deck_height",
          fmt::format("found {}, expected above the pin at top dead centre, {}", p.deck_height,
                      0.5 * p.stroke + p.rod_length));
  require(t, p.liner_bottom() > 0.5 * p.stroke, "liner_length",
          fmt::format("found {}, expected the liner to end above the crank pin's circle (z = {})",
                      p.liner_length, 0.5 * p.stroke));
  require(t, p.end_wall + p.jacket_thickness > p.liner_wall, "end_wall",
          "expected to clear the opening around the last liner");
  require(t, p.jacket_bottom() > p.roof(), "jacket_depth",
          fmt::format("found {}, expected less than {}: the liner needs a lower land",
                      p.jacket_depth, p.jacket_top() - p.roof()));
  require(t, p.crankcase_top > p.roof() && p.crankcase_top < p.jacket_top(), "crankcase_top",
          "expected between the crankcase's roof and the deck plate");
  require(t, p.shoulder_height > 0.0 && p.shoulder_height < p.liner_bottom(), "shoulder_height",
          "expected between the crank axis and the liner's lower end");
  require(t, p.crankcase_half_width - p.crankcase_wall > 0.5 * p.stroke + 0.35 * p.bore,
          "crankcase_half_width",
          "expected clearance for the crank: half stroke + 0.35 bore + wall");
  require(t, p.column_reach < p.housing_radius() + p.deck_overhang, "column_reach",
          "expected below the deck plate's edge");
  require(t, p.bearing_boss > p.bearing_bore, "bearing_boss", "expected more than bearing_bore");
  require(t, p.bearing_width >= p.bearing_wall, "bearing_width", "expected at least bearing_wall");
  require(t, -0.5 * p.bearing_boss > -p.skirt_depth, "skirt_depth",
          "expected the pan flange below the bearing bosses");
  require(t, p.bearing_wall_bottom > -0.5 * p.bearing_boss && p.bearing_wall_bottom < 0.0,
          "bearing_wall_bottom", "expected between the boss's lower edge and the crank axis");
}

// Half width of the openings in the bearing walls, of the liner's radius: wider than the part of
// the liner above the wall.
constexpr double kWindow = 0.75;

// --- solids --------------------------------------------------------------------------------------

// A polygon of (y, z), mirrored at y = 0, extruded along x.
Solid symmetric_prism(GmshSession& s, const std::vector<std::array<double, 2>>& right, double x0,
                      double x1) {
  std::vector<Vector3d> polygon;
  for (const auto& [y, z] : right) polygon.emplace_back(x0, y, z);
  for (auto p = right.rbegin(); p != right.rend(); ++p) polygon.emplace_back(x0, -(*p)[0], (*p)[1]);
  return s.prism(polygon, {x1 - x0, 0.0, 0.0});
}

Solid upright(GmshSession& s, double x, double radius, double z0, double z1) {
  return s.cylinder({x, 0.0, z0}, {0.0, 0.0, z1 - z0}, radius);
}

// Half width of the crankcase's roof step: a little more than the housing, so that no cylinder
// touches an edge in a point.
double top_half_width(const BlockParameters& p) { return p.housing_radius() + p.outer_wall; }

Solid outer_shell(GmshSession& s, const BlockParameters& p) {
  const double l = p.half_length(), w = p.crankcase_half_width;
  const Solid crankcase = symmetric_prism(
      s, {{w, -p.skirt_depth}, {w, p.shoulder_height}, {top_half_width(p), p.crankcase_top}}, -l,
      l);
  const double low = 0.5 * (p.roof() + p.crankcase_top);  // inside the crankcase's roof
  const double plate = p.housing_radius() + p.deck_overhang;
  Solids parts;
  for (int i = 0; i < p.cylinders; ++i) {
    parts.push_back(upright(s, p.x_of_cylinder(i), p.housing_radius(), low, p.deck_height));
  }
  for (int k = 0; k <= p.cylinders; ++k) {
    const double x = p.x_of_bearing(k), half = 0.5 * p.column_width;
    parts.push_back(s.box({std::max(x - half, -l), -p.column_reach, low},
                          {std::min(x + half, l), p.column_reach, p.deck_height}));
  }
  for (double side : {-1.0, 1.0}) {
    const double a = side * l, b = side * (l - p.end_wall - 0.5 * p.outer_wall);
    parts.push_back(s.box({std::min(a, b), -p.column_reach, low},
                          {std::max(a, b), p.column_reach, p.deck_height}));
  }
  parts.push_back(s.box({-l, -plate, p.jacket_top()}, {l, plate, p.deck_height}));
  parts.push_back(s.box({-l, -w - p.flange_width, -p.skirt_depth},
                        {l, w + p.flange_width, -p.skirt_depth + p.flange_thickness}));
  return require_one(s.fuse({crankcase}, parts), "block: outer shape");
}

// The slope's inner line, `wall` inside the outer one: y at height z.
double inner_slope(const BlockParameters& p, double z) {
  const double dy = p.crankcase_half_width - top_half_width(p);
  const double dz = p.crankcase_top - p.shoulder_height;
  const double outer = p.crankcase_half_width - dy * (z - p.shoulder_height) / dz;
  return outer - p.crankcase_wall * std::hypot(dy, dz) / dz;
}

Solid jacket(GmshSession& s, const BlockParameters& p, int i) {
  return upright(s, p.x_of_cylinder(i), p.jacket_radius(), p.jacket_bottom(), p.jacket_top());
}

// The jacket of a parent bore: in pieces where walls of neighbours meet.
Solids jacket_around_walls(GmshSession& s, const BlockParameters& p, int i) {
  Solids walls;
  for (int j = std::max(i - 1, 0); j <= std::min(i + 1, p.cylinders - 1); ++j) {
    walls.push_back(
        upright(s, p.x_of_cylinder(j), p.liner_radius(), p.jacket_bottom(), p.jacket_top()));
  }
  return s.cut({jacket(s, p, i)}, walls);
}

Solids hollows(GmshSession& s, const BlockParameters& p) {
  const double w = p.crankcase_half_width - p.crankcase_wall, roof = p.roof();
  // Where the vertical inner wall meets the inner slope.
  const double dy = p.crankcase_half_width - top_half_width(p);
  const double slope = dy / (p.crankcase_top - p.shoulder_height);
  const double bend = p.shoulder_height + (inner_slope(p, p.shoulder_height) - w) / slope;
  const double below = -p.skirt_depth;
  Solids tools;
  const double half = 0.5 * (p.cylinder_pitch - p.bearing_wall);
  const double bore = p.parent_bores ? 0.5 * p.bore : p.liner_radius();
  const double bore_top = p.timing ? p.deck_height : p.deck_height + 1.0;  // closed by the head
  for (int i = 0; i < p.cylinders; ++i) {
    const double x = p.x_of_cylinder(i);
    tools.push_back(symmetric_prism(s, {{w, below}, {w, bend}, {inner_slope(p, roof), roof}},
                                    x - half, x + half));
    if (p.parent_bores) {
      const Solids water = jacket_around_walls(s, p, i);
      tools.insert(tools.end(), water.begin(), water.end());
    } else {
      tools.push_back(jacket(s, p, i));
    }
    tools.push_back(upright(s, x, bore, roof, bore_top));
    if (p.has_relief()) {
      tools.push_back(upright(s, x, p.relief_radius(), p.relief_bottom(), roof));
    }
  }
  if (!p.parent_bores) {
    // The bearing walls are open around the liners' free lower ends: they connect the chambers.
    const double reach = p.x_of_cylinder(p.cylinders - 1) + p.liner_radius() + p.liner_wall;
    const double window = kWindow * p.liner_radius();
    tools.push_back(
        s.box({-reach, -window, p.liner_bottom() - p.liner_protrusion}, {reach, window, roof}));
  }
  const double end = p.half_length() - 1.5 * p.end_wall;
  tools.push_back(s.box({-end, -w, below}, {end, w, p.bearing_wall_bottom}));
  return tools;
}

Solids bearing_bosses(GmshSession& s, const BlockParameters& p) {
  Solids bosses;
  const double l = p.half_length();
  for (int k = 0; k <= p.cylinders; ++k) {
    const double a = std::max(p.x_of_bearing(k) - 0.5 * p.bearing_width, -l);
    const double b = std::min(p.x_of_bearing(k) + 0.5 * p.bearing_width, l);
    bosses.push_back(s.cylinder({a, 0.0, 0.0}, {b - a, 0.0, 0.0}, 0.5 * p.bearing_boss));
  }
  return bosses;
}

// Bearing walls that carry the pads: the second from each end where there are that many.
std::array<int, 2> mount_walls(const BlockParameters& p) {
  if (p.cylinders < 3) return {0, p.cylinders};
  return {1, p.cylinders - 1};
}

Solids mount_pads(GmshSession& s, const BlockParameters& p) {
  Solids pads;
  const double w = p.crankcase_half_width, root = w - 0.5 * p.crankcase_wall;
  const double l = p.half_length();
  for (int k : mount_walls(p)) {
    const double a = std::max(p.x_of_bearing(k) - 0.5 * p.mount_length, -l);
    const double b = std::min(p.x_of_bearing(k) + 0.5 * p.mount_length, l);
    const double out = w + p.mount_thickness;
    pads.push_back(s.box({a, root, 0.0}, {b, out, p.mount_height}));
    pads.push_back(s.box({a, -out, 0.0}, {b, -root, p.mount_height}));
  }
  return pads;
}

Solids liners(GmshSession& s, const BlockParameters& p) {
  Solids result;
  for (int i = 0; i < p.cylinders; ++i) {
    const double x = p.x_of_cylinder(i);
    const Solid outside = upright(s, x, p.liner_radius(), p.liner_bottom(), p.deck_height);
    const Solid inside = upright(s, x, 0.5 * p.bore, p.liner_bottom(), p.deck_height);
    result.push_back(require_one(s.cut({outside}, {inside}), "block: liner"));
  }
  return result;
}

// --- surfaces ------------------------------------------------------------------------------------

NamedSurface outer_surface(const BlockParameters& p) {
  const double roof = p.roof(), w = p.crankcase_half_width - p.crankcase_wall;
  const double r = p.jacket_radius(), deck = p.deck_height, pan = -p.skirt_depth;
  SurfaceFilter filter;
  filter.outside = {
      {{-kFar, -w, pan}, {kFar, w, roof}},                                // crankcase
      {{-kFar, -r, p.jacket_bottom()}, {kFar, r, p.jacket_top()}},        // jackets
      {{-kFar, -p.liner_radius(), 0.0}, {kFar, p.liner_radius(), deck}},  // bores
      {{-kFar, -kFar, pan}, {kFar, kFar, pan}},                           // pan flange
      {{-kFar, -kFar, deck}, {kFar, kFar, deck}},                         // deck
  };
  if (p.timing) {
    for (const BoxFilter& box : under_timing_covers(p)) filter.outside.push_back(box);
  }
  return {"outer", {filter}};
}

std::vector<NamedSurface> block_surfaces(const BlockParameters& p) {
  std::vector<NamedSurface> surfaces;
  for (int i = 0; i < p.cylinders; ++i) {
    const double x = p.x_of_cylinder(i), r = p.liner_radius();
    SurfaceFilter bore;
    bore.cylinder = CylinderFilter{0.5 * p.bore, {x, 0.0, 0.0}, Vector3d::UnitZ()};
    surfaces.push_back({fmt::format("liner_{}_bore", i + 1), {bore}});
    if (p.parent_bores && !p.timing) continue;
    surfaces.push_back(in_plane(fmt::format("head_{}", i + 1), Vector3d::UnitZ(), p.deck_height,
                                {{x - r, -r, -kFar}, {x + r, r, kFar}}));
  }
  for (int k = 0; k <= p.cylinders; ++k) {
    SurfaceFilter bearing;
    const double x = p.x_of_bearing(k), half = 0.5 * p.cylinder_pitch;
    bearing.cylinder = CylinderFilter{0.5 * p.bearing_bore, Vector3d::Zero(), Vector3d::UnitX()};
    bearing.box = BoxFilter{{x - half, -kFar, -kFar}, {x + half, kFar, kFar}};
    surfaces.push_back({fmt::format("bearing_{}", k + 1), {bearing}});
  }
  int mount = 1;
  for (int k : mount_walls(p)) {
    const double x = p.x_of_bearing(k), half = 0.5 * p.cylinder_pitch;
    for (double side : {1.0, -1.0}) {
      surfaces.push_back(in_plane(fmt::format("mount_{}", mount++), {0.0, side, 0.0},
                                  p.crankcase_half_width + p.mount_thickness,
                                  {{x - half, -kFar, 0.0}, {x + half, kFar, p.mount_height}}));
    }
  }
  surfaces.push_back(in_plane("pan_flange", Vector3d::UnitZ(), -p.skirt_depth));
  if (p.timing) {
    const auto timing = timing_surfaces(p);
    surfaces.insert(surfaces.end(), timing.begin(), timing.end());
  } else {
    surfaces.push_back(in_plane("deck", Vector3d::UnitZ(), p.deck_height));
  }
  surfaces.push_back(outer_surface(p));
  return surfaces;
}

}  // namespace

const keys::Keys<BlockParameters>& block_keys() {
  static const keys::Keys<BlockParameters> keys(
      "block", "the block of an inline engine", [](auto& key, BlockParameters& p) {
        key.integer("cylinders", p.cylinders, {1, 8}, "number of cylinders");
        key.choice("bores", p.parent_bores, {{"wet_liner", false}, {"parent", true}},
                   "wet liners, or bores in the casting");
        length(key, "bore", p.bore, "diameter of the cylinders");
        length(key, "stroke", p.stroke, "stroke of the pistons");
        length(key, "rod_length", p.rod_length,
               "length of the connecting rod, from centre to centre");
        length(key, "cylinder_pitch", p.cylinder_pitch, "distance of neighbouring cylinder axes");
        length(key, "deck_height", p.deck_height, "height of the deck above the crank axis");
        length(key, "deck_thickness", p.deck_thickness, "thickness of the deck plate");
        length(key, "deck_overhang", p.deck_overhang,
               "how far the deck plate reaches over the housing's walls");
        length(key, "liner_wall", p.liner_wall,
               "thickness of the liners, or of the walls of parent bores");
        length(key, "liner_length", p.liner_length, "length of the liners from the deck down");
        length(key, "liner_protrusion", p.liner_protrusion,
               "length of the liners below the lower deck, free in the crankcase")
            .needs("bores", "wet_liner", "parent bores end at the roof");
        length(key, "jacket_thickness", p.jacket_thickness,
               "thickness of the water around the liners");
        length(key, "jacket_depth", p.jacket_depth, "depth of the water below the deck plate");
        length(key, "outer_wall", p.outer_wall, "thickness of the housing around the water");
        length(key, "end_wall", p.end_wall, "thickness of the walls at the front and rear");
        length(key, "column_width", p.column_width,
               "width of the columns of the head bolts, along the crankshaft");
        length(key, "column_reach", p.column_reach,
               "half width of these columns across the crankshaft");
        length(key, "crankcase_half_width", p.crankcase_half_width,
               "half of the crankcase's width");
        length(key, "crankcase_wall", p.crankcase_wall, "thickness of the crankcase's walls");
        length(key, "shoulder_height", p.shoulder_height,
               "height above the crank axis at which the crankcase begins to narrow");
        length(key, "crankcase_top", p.crankcase_top,
               "height above the crank axis at which it ends to narrow");
        length(key, "skirt_depth", p.skirt_depth, "depth of the pan flange below the crank axis");
        length(key, "flange_width", p.flange_width, "width of the pan flange");
        length(key, "flange_thickness", p.flange_thickness, "thickness of the pan flange");
        length(key, "bearing_wall", p.bearing_wall,
               "thickness of the walls that carry the main bearings");
        key.number("bearing_wall_bottom", p.bearing_wall_bottom, {},
                   "height of the lower edge of the inner bearing walls, from the crank axis")
            .shown_in("length_unit");
        length(key, "bearing_bore", p.bearing_bore, "diameter of the main bearings");
        length(key, "bearing_boss", p.bearing_boss, "outer diameter of the main bearings");
        length(key, "bearing_width", p.bearing_width,
               "length of the main bearings along the crankshaft");
        length(key, "mount_length", p.mount_length,
               "length of the mount pads along the crankshaft");
        length(key, "mount_height", p.mount_height, "height of the mount pads");
        length(key, "mount_thickness", p.mount_thickness, "thickness of the mount pads");
        key.table("timing", p.timing, timing_keys());
        key.check([](const Config& table, BlockParameters& block) {
          check_block(table, block);
          if (block.timing) finish_timing_side(table.table("timing"), block, *block.timing);
        });
      });
  return keys;
}

PartGeometry build_block(GmshSession& s, const BlockParameters& p) {
  Solid block = outer_shell(s, p);
  Solids openings = hollows(s, p);
  if (p.timing) {
    block = require_one(s.fuse({block}, timing_walls(s, p)), "block: head and front plate");
    const Solids timing = timing_openings(s, p);
    openings.insert(openings.end(), timing.begin(), timing.end());
  }
  block = require_one(s.cut({block}, openings), "block: hollows");
  Solids added = bearing_bosses(s, p);
  const Solids pads = mount_pads(s, p);
  added.insert(added.end(), pads.begin(), pads.end());
  block = require_one(s.fuse({block}, added), "block: bearing bosses and mounts");
  const double l = p.half_length() + 1.0;
  Solids bores = {s.cylinder({-l, 0.0, 0.0}, {2.0 * l, 0.0, 0.0}, 0.5 * p.bearing_bore)};
  if (p.timing) {
    const Solids seals = crank_seals(s, p);
    bores.insert(bores.end(), seals.begin(), seals.end());
  }
  block = require_one(s.cut({block}, bores), "block: bearing bore");
  if (p.parent_bores) return {{{"block", {block}}}, block_surfaces(p)};

  Solids all = {block};
  const Solids sleeves = liners(s, p);
  all.insert(all.end(), sleeves.begin(), sleeves.end());
  const std::vector<Solids> pieces = s.fragment(all);
  PartGeometry part;
  part.regions = {{"block", pieces.front()}, {"liner", {}}};
  for (size_t i = 1; i < pieces.size(); ++i) {
    part.regions[1].solids.push_back(require_one(pieces[i], "block: liner"));
  }
  part.surfaces = block_surfaces(p);
  return part;
}

}  // namespace clatter::mesh
