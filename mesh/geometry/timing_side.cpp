// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/timing_side.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/geometry/block_geometry.hpp"
#include "mesh/geometry/length_row.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// --- reading -------------------------------------------------------------------------------------

// A round or rectangular area of the front face that one part occupies.
struct Seat {
  const char* key;
  Vector2d centre;
  double half_width, half_height;
};

std::array<Seat, 4> seats(const TimingSide& t) {
  const double bolt = 0.5 * t.bolt_boss, pivot = 0.5 * t.pivot_boss;
  return {{{"guide_bolt_1", t.guide_bolt_1, bolt, bolt},
           {"guide_bolt_2", t.guide_bolt_2, bolt, bolt},
           {"arm_pivot", t.arm_pivot, pivot, pivot},
           {"tensioner", t.tensioner, 0.5 * t.tensioner_width, 0.5 * t.tensioner_height}}};
}

// Boxes around two seats: apart when a gap remains in either direction.
bool apart(const Seat& a, const Seat& b) {
  const Vector2d d = (a.centre - b.centre).cwiseAbs();
  return d.x() > a.half_width + b.half_width || d.y() > a.half_height + b.half_height;
}

void check_head(const Config& table, const TimingSide& t, const BlockParameters& p) {
  const auto require = [&](bool holds, const char* key, const std::string& message) {
    if (!holds) table.fail(key, message);
  };
  const double cam_space = p.deck_height + t.fire_deck + t.head_jacket + t.cam_deck;
  for (const auto& [key, cam] :
       {std::pair{"cam_intake", t.cam_intake}, std::pair{"cam_exhaust", t.cam_exhaust}}) {
    require(cam.y() - 0.5 * t.cam_bore > cam_space, key,
            fmt::format("found a bearing down to Y = {}, expected it above the cam deck at {}",
                        cam.y() - 0.5 * t.cam_bore, cam_space));
    require(cam.y() - t.head_top() < 0.35 * t.cam_boss, key,
            fmt::format("found {} above the other camshaft, expected less than 0.35 cam_boss = {}",
                        cam.y() - t.head_top(), 0.35 * t.cam_boss));
    require(std::abs(cam.x()) + 0.5 * t.cam_boss < t.head_half_width, "head_half_width",
            fmt::format("found {}, expected more than {}: {} with its boss lies inside",
                        t.head_half_width, std::abs(cam.x()) + 0.5 * t.cam_boss, key));
  }
  require(std::abs(t.cam_intake.x() - t.cam_exhaust.x()) > t.cam_boss, "cam_boss",
          "expected less than the distance of the camshafts");
  require(t.cam_bore < t.cam_seal, "cam_seal", "expected more than cam_bore");
  require(t.cam_seal < t.cam_boss, "cam_seal", "expected less than cam_boss");
  require(t.cam_bearing_width < p.cylinder_pitch - t.plug_tower, "plug_tower",
          fmt::format("found {}, expected less than the {} between two bulkheads", t.plug_tower,
                      p.cylinder_pitch - t.cam_bearing_width));
  require(p.x_of_bearing(0) - 0.5 * t.cam_bearing_width > -p.half_length(), "cam_bearing_width",
          "expected the end bearings inside the block");
  require(t.head_wall < t.head_half_width - 0.5 * t.plug_tower, "head_wall",
          "expected less than the distance from the plug tower to the head's side");
}

void check_plate(const Config& table, const TimingSide& t, const BlockParameters& p) {
  const auto require = [&](bool holds, const char* key, const std::string& message) {
    if (!holds) table.fail(key, message);
  };
  require(t.plate_thickness <
              p.half_length() + p.x_of_bearing(0) + 0.5 * p.cylinder_pitch - 0.5 * p.bore,
          "plate_thickness", "expected to end before the first bore");
  require(t.crank_seal > p.bearing_bore && t.crank_seal < p.bearing_boss, "crank_seal",
          fmt::format("found {}, expected between bearing_bore and bearing_boss", t.crank_seal));
  require(p.x_of_bearing(0) - 0.5 * p.bearing_width > -p.half_length(), "crank_seal",
          "expected the first main bearing (bearing_width) to end behind the front face");
  std::vector<Seat> taken = {
      {"the crankshaft", Vector2d::Zero(), 0.5 * t.crank_seal, 0.5 * t.crank_seal},
      {"cam_intake", t.cam_intake, 0.5 * t.cam_seal, 0.5 * t.cam_seal},
      {"cam_exhaust", t.cam_exhaust, 0.5 * t.cam_seal, 0.5 * t.cam_seal}};
  for (const Seat& seat : seats(t)) {
    require(std::abs(seat.centre.x()) + seat.half_width < t.plate_half_width, seat.key,
            fmt::format("found a seat from X = {} to {}, expected within plate_half_width = {}",
                        seat.centre.x() - seat.half_width, seat.centre.x() + seat.half_width,
                        t.plate_half_width));
    require(seat.centre.y() - seat.half_height > -p.skirt_depth &&
                seat.centre.y() + seat.half_height < t.head_top(),
            seat.key,
            fmt::format("found a seat from Y = {} to {}, expected between {} and {}",
                        seat.centre.y() - seat.half_height, seat.centre.y() + seat.half_height,
                        -p.skirt_depth, t.head_top()));
    for (const Seat& other : taken) {
      require(apart(seat, other), seat.key,
              fmt::format("expected a gap between its seat and {}", other.key));
    }
    taken.push_back(seat);
  }
}

// --- solids --------------------------------------------------------------------------------------

struct Interval {
  double from, to;
};

// Along x of bulkhead k of the head; the end ones reach the faces of the block.
Interval bulkhead(const BlockParameters& p, int k) {
  const double x = p.x_of_bearing(k), half = 0.5 * p.timing->cam_bearing_width;
  return {k == 0 ? -p.half_length() : x - half, k == p.cylinders ? p.half_length() : x + half};
}

Solid along_x(GmshSession& s, const Vector2d& at, Interval x, double diameter) {
  return s.cylinder(from_front_view(at, x.from), {x.to - x.from, 0.0, 0.0}, 0.5 * diameter);
}

// Between the end faces and the bearings of that length next to them.
std::array<Interval, 2> before_bearings(const BlockParameters& p, double length) {
  const double bearing = -p.x_of_bearing(0) + 0.5 * length, end = p.half_length() + 1.0;
  return {{{-end, -bearing}, {bearing, end}}};
}

}  // namespace

const keys::Keys<TimingSide>& timing_keys() {
  static const keys::Keys<TimingSide> keys(
      "timing",
      "front plate and head of a timing drive; positions are X to the right and Y up in the front "
      "view, from the crank axis",
      [](auto& key, TimingSide& t) {
        const auto position = [&key](const char* name, Vector2d& at, const char* meaning) {
          key.vector(name, at, {}, meaning).required().shown_in("length_unit");
        };
        position("cam_intake", t.cam_intake, "centre of the intake camshaft");
        position("cam_exhaust", t.cam_exhaust, "centre of the exhaust camshaft");
        position("guide_bolt_1", t.guide_bolt_1, "centre of the guide's first bolt");
        position("guide_bolt_2", t.guide_bolt_2, "centre of the guide's second bolt");
        position("arm_pivot", t.arm_pivot, "centre of the tensioner arm's pivot");
        position("tensioner", t.tensioner, "centre of the tensioner's seat");
        length(key, "cam_bore", t.cam_bore, "diameter of the camshaft bearings");
        length(key, "cam_boss", t.cam_boss, "outer diameter of the camshaft bearings");
        length(key, "cam_bearing_width", t.cam_bearing_width,
               "length of the camshaft bearings along the crankshaft");
        length(key, "cam_seal", t.cam_seal,
               "diameter of the openings before the end bearings of the camshafts; between bore "
               "and boss without it");
        length(key, "crank_seal", t.crank_seal, "the same of the crankshaft");
        length(key, "head_wall", t.head_wall, "thickness of the head's walls");
        length(key, "fire_deck", t.fire_deck, "height of the head's lower deck");
        length(key, "head_jacket", t.head_jacket, "height of the head's hollow");
        length(key, "cam_deck", t.cam_deck, "height of the head's upper deck");
        length(key, "plug_tower", t.plug_tower, "diameter of the towers between the two decks");
        length(key, "plate_thickness", t.plate_thickness, "thickness of the front plate");
        length(key, "bolt_boss", t.bolt_boss, "diameter of the guide bolts' seats");
        length(key, "pivot_boss", t.pivot_boss, "diameter of the arm pivot's seat");
        length(key, "tensioner_width", t.tensioner_width, "width of the tensioner's seat");
        length(key, "tensioner_height", t.tensioner_height, "height of the tensioner's seat");
        length(key, "boss_length", t.boss_length, "length of all seats before the front face");
        length(key, "head_half_width", t.head_half_width,
               "half width of the head; head_wall beside the camshaft bearings without it");
        length(key, "plate_half_width", t.plate_half_width,
               "of the front plate, from the crank axis; beside the seats and the head without it");
      });
  return keys;
}

void finish_timing_side(const Config& table, const BlockParameters& p, TimingSide& t) {
  if (t.cam_seal == 0.0) t.cam_seal = 0.5 * (t.cam_bore + t.cam_boss);
  if (t.crank_seal == 0.0) t.crank_seal = 0.5 * (p.bearing_bore + p.bearing_boss);
  const double cams = std::max(std::abs(t.cam_intake.x()), std::abs(t.cam_exhaust.x()));
  if (t.head_half_width == 0.0) t.head_half_width = cams + 0.5 * t.cam_boss + t.head_wall;
  if (t.plate_half_width == 0.0) {
    t.plate_half_width = t.head_half_width + t.plate_thickness;
    for (const Seat& seat : seats(t))
      t.plate_half_width =
          std::max(t.plate_half_width,
                   std::abs(seat.centre.x()) + seat.half_width + 0.5 * t.plate_thickness);
  }
  check_head(table, t, p);
  check_plate(table, t, p);
}

Solids timing_walls(GmshSession& s, const BlockParameters& p) {
  const TimingSide& t = *p.timing;
  const double l = p.half_length(), top = t.head_top();
  Solids parts;
  parts.push_back(s.box({-l, -t.head_half_width, p.deck_height}, {l, t.head_half_width, top}));
  parts.push_back(s.box({-l, -t.plate_half_width, -p.skirt_depth},
                        {-l + t.plate_thickness, t.plate_half_width, top}));
  for (const Vector2d& cam : t.cams()) {
    for (int k = 0; k <= p.cylinders; ++k) {
      parts.push_back(along_x(s, cam, bulkhead(p, k), t.cam_boss));
    }
  }
  const Interval boss{-l - t.boss_length, -l + 0.5 * t.plate_thickness};
  parts.push_back(along_x(s, t.guide_bolt_1, boss, t.bolt_boss));
  parts.push_back(along_x(s, t.guide_bolt_2, boss, t.bolt_boss));
  parts.push_back(along_x(s, t.arm_pivot, boss, t.pivot_boss));
  const Vector3d half(0.0, 0.5 * t.tensioner_width, 0.5 * t.tensioner_height);
  parts.push_back(s.box(from_front_view(t.tensioner, boss.from) - half,
                        from_front_view(t.tensioner, boss.to) + half));
  return parts;
}

Solids timing_openings(GmshSession& s, const BlockParameters& p) {
  const TimingSide& t = *p.timing;
  const double y = t.head_half_width - t.head_wall;
  const double lower = p.deck_height + t.fire_deck, upper = lower + t.head_jacket;
  Solids tools;
  for (int i = 0; i < p.cylinders; ++i) {
    const double a = bulkhead(p, i).to, b = bulkhead(p, i + 1).from;
    const Solid tower =
        s.cylinder({p.x_of_cylinder(i), 0.0, lower}, {0, 0, t.head_jacket}, 0.5 * t.plug_tower);
    const Solid hollow = s.box({a, -y, lower}, {b, y, upper});
    tools.push_back(require_one(s.cut({hollow}, {tower}), "block: head jacket"));
    tools.push_back(s.box({a, -y, upper + t.cam_deck}, {b, y, t.head_top() + t.cam_boss}));
  }
  const Interval through{-p.half_length() - 1.0, p.half_length() + 1.0};
  for (const Vector2d& cam : t.cams()) {
    tools.push_back(along_x(s, cam, through, t.cam_bore));
    for (const Interval& end : before_bearings(p, t.cam_bearing_width)) {
      tools.push_back(along_x(s, cam, end, t.cam_seal));
    }
  }
  return tools;
}

Solids crank_seals(GmshSession& s, const BlockParameters& p) {
  Solids tools;
  for (const Interval& end : before_bearings(p, p.bearing_width)) {
    tools.push_back(along_x(s, Vector2d::Zero(), end, p.timing->crank_seal));
  }
  return tools;
}

std::vector<NamedSurface> timing_surfaces(const BlockParameters& p) {
  const TimingSide& t = *p.timing;
  std::vector<NamedSurface> surfaces;
  for (const auto& [name, cam] :
       {std::pair{"cam_intake", t.cam_intake}, std::pair{"cam_exhaust", t.cam_exhaust}}) {
    for (int k = 0; k <= p.cylinders; ++k) {
      const double x = p.x_of_bearing(k), half = 0.5 * p.cylinder_pitch;
      SurfaceFilter bearing;
      bearing.cylinder =
          CylinderFilter{0.5 * t.cam_bore, from_front_view(cam, 0.0), Vector3d::UnitX()};
      bearing.box = BoxFilter{{x - half, -kFar, -kFar}, {x + half, kFar, kFar}};
      surfaces.push_back({fmt::format("{}_{}", name, k + 1), {bearing}});
    }
  }
  const double front = -p.half_length();
  for (const Seat& seat : seats(t)) {
    const Vector3d centre = from_front_view(seat.centre, front - t.boss_length);
    const Vector3d half(1.0, seat.half_width, seat.half_height);
    surfaces.push_back(
        in_plane(seat.key, Vector3d::UnitX(), centre.x(), {centre - half, centre + half}));
  }
  surfaces.push_back(in_plane("timing_face", Vector3d::UnitX(), front));
  return surfaces;
}

std::vector<BoxFilter> under_timing_covers(const BlockParameters& p) {
  const TimingSide& t = *p.timing;
  const double y = t.head_half_width - t.head_wall;
  return {{{-kFar, -kFar, -kFar}, {-p.half_length(), kFar, kFar}},
          {{-kFar, -y, p.deck_height}, {kFar, y, kFar}},
          {{-kFar, -kFar, t.head_top()}, {kFar, kFar, kFar}}};
}

}  // namespace clatter::mesh
