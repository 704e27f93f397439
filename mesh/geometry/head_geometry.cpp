// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/head_geometry.hpp"

#include <fmt/format.h>

#include "mesh/geometry/length_row.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

void check_head(const Config& t, const HeadParameters& p) {
  const auto require = [&](bool holds, const char* key, const std::string& message) {
    if (!holds) t.fail(key, message);
  };
  const double bores = (p.cylinders - 1) * p.cylinder_pitch + p.bore;
  require(p.bore < p.cylinder_pitch, "bore", "expected less than cylinder_pitch");
  require(p.bore < p.width, "bore", "expected less than width");
  require(p.length > bores, "length",
          fmt::format("found {:g}, expected more than the {:g} of the bores", p.length, bores));
  require(2.0 * p.wall < std::min(p.width - p.tower, p.cylinder_pitch), "wall",
          "expected room for the jackets beside the towers");
  require(p.tower < p.cylinder_pitch - p.bulkhead, "tower",
          fmt::format("found {:g}, expected less than the {:g} between two bulkheads", p.tower,
                      p.cylinder_pitch - p.bulkhead));
  require(p.recess < p.fire_deck, "recess", "expected less than fire_deck");
  require(p.deck_top() + p.seat_height < p.height, "height",
          fmt::format("found {:g}, expected more than the {:g} of the bolts' seats", p.height,
                      p.deck_top() + p.seat_height));
  const double aside = p.bolt_reach + 0.5 * p.seat, end = p.x_of_bolt(p.cylinders) + 0.5 * p.seat;
  require(
      aside < 0.5 * p.width, "bolt_reach",
      fmt::format("found seats to {:g} from the middle, expected less than half the width", aside));
  require(
      end < 0.5 * p.length, "seat",
      fmt::format("found seats to {:g} from the middle, expected less than half the length", end));
}

/// The space around the valves, without the seats of the bolts.
Solids valve_space(GmshSession& s, const HeadParameters& p) {
  const double x = 0.5 * p.length - p.wall, y = 0.5 * p.width - p.wall, low = p.deck_top();
  Solids seats;
  for (int k = 0; k <= p.cylinders; ++k)
    for (const double side : {1.0, -1.0})
      seats.push_back(s.cylinder({p.x_of_bolt(k), side * p.bolt_reach, low - 1.0},
                                 {0.0, 0.0, p.seat_height + 1.0}, 0.5 * p.seat));
  return s.cut({s.box({-x, -y, low}, {x, y, p.height + 1.0})}, seats);
}

Solid jacket(GmshSession& s, const HeadParameters& p, int i) {
  const double y = 0.5 * p.width - p.wall, x = p.x_of_cylinder(i);
  const double half = 0.5 * (p.cylinder_pitch - p.bulkhead);
  const Solid hollow = s.box({x - half, -y, p.fire_deck}, {x + half, y, p.fire_deck + p.jacket});
  const Solid tower = s.cylinder({x, 0.0, p.fire_deck}, {0.0, 0.0, p.jacket}, 0.5 * p.tower);
  return require_one(s.cut({hollow}, {tower}), "head: jacket");
}

NamedSurface sides(const HeadParameters& p) {
  NamedSurface outer{"outer", {}};
  for (const double side : {1.0, -1.0})
    for (const auto& [normal, half] : {std::pair<Vector3d, double>(Vector3d::UnitX(), p.length),
                                       std::pair<Vector3d, double>(Vector3d::UnitY(), p.width)})
      outer.filters.push_back(in_plane("", normal, side * 0.5 * half).filters.front());
  return outer;
}

std::vector<NamedSurface> head_surfaces(const HeadParameters& p) {
  std::vector<NamedSurface> out = {in_plane("fire_deck", Vector3d::UnitZ(), 0.0),
                                   in_plane("cover_flange", Vector3d::UnitZ(), p.height), sides(p)};
  const auto around = [](double x, double y, double half) {
    return BoxFilter{{x - half, y - half, -kFar}, {x + half, y + half, kFar}};
  };
  for (int i = 0; i < p.cylinders; ++i)
    out.push_back(in_plane(fmt::format("roof_{}", i + 1), Vector3d::UnitZ(), p.recess,
                           around(p.x_of_cylinder(i), 0.0, 0.5 * p.cylinder_pitch)));
  for (int k = 0; k <= p.cylinders; ++k)
    for (const int side : {0, 1})
      out.push_back(in_plane(
          fmt::format("bolt_{}", 2 * k + side + 1), Vector3d::UnitZ(), p.deck_top() + p.seat_height,
          around(p.x_of_bolt(k), (side == 0 ? 1.0 : -1.0) * p.bolt_reach, 0.55 * p.seat)));
  return out;
}

}  // namespace

const keys::Keys<HeadParameters>& head_keys() {
  static const keys::Keys<HeadParameters> keys(
      "head", "the cylinder head of an inline engine, without ports",
      [](auto& key, HeadParameters& p) {
        key.integer("cylinders", p.cylinders, {1, 8}, "number of cylinders");
        length(key, "bore", p.bore, "diameter of the cylinders");
        length(key, "cylinder_pitch", p.cylinder_pitch, "distance of neighbouring cylinder axes");
        length(key, "length", p.length, "along the crankshaft");
        length(key, "width", p.width, "across it");
        length(key, "height", p.height, "of the cover's flange above the gasket");
        length(key, "fire_deck", p.fire_deck, "thickness of the lower deck");
        length(key, "recess", p.recess, "depth of the roofs in it, over the bores");
        length(key, "jacket", p.jacket, "height of the water between the decks");
        length(key, "upper_deck", p.upper_deck, "thickness of the upper deck");
        length(key, "wall", p.wall, "thickness of the walls");
        length(key, "bulkhead", p.bulkhead, "thickness of the walls between two cylinders' water");
        length(key, "tower", p.tower, "diameter of the towers between the decks");
        length(key, "bolt_reach", p.bolt_reach,
               "distance of the head bolts from the cylinders' plane; there are two between "
               "cylinders and at each end");
        length(key, "seat", p.seat, "diameter of the bolts' seats");
        length(key, "seat_height", p.seat_height, "of the seats above the upper deck");
        key.check(check_head);
      });
  return keys;
}

PartGeometry build_head(GmshSession& s, const HeadParameters& p) {
  const double x = 0.5 * p.length, y = 0.5 * p.width;
  Solids openings = valve_space(s, p);
  for (int i = 0; i < p.cylinders; ++i) {
    openings.push_back(jacket(s, p, i));
    openings.push_back(
        s.cylinder({p.x_of_cylinder(i), 0.0, -1.0}, {0.0, 0.0, p.recess + 1.0}, 0.5 * p.bore));
  }
  const Solids head = s.cut({s.box({-x, -y, 0.0}, {x, y, p.height})}, openings);
  PartGeometry part;
  part.regions = {{"head", {require_one(head, "head")}}};
  part.surfaces = head_surfaces(p);
  return part;
}

}  // namespace clatter::mesh
