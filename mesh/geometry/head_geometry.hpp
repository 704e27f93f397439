// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The cylinder head of an inline engine from its main dimensions, without ports and valves.
//
// Frame: x along the crankshaft, y toward the thrust side, z up; origin in the plane of the gasket,
// in the middle between the first and the last cylinder. All lengths in the part's unit.
//
//      z   cover_flange   ||_            _||    height
//      |                  ||   valves     ||    wall
//      |                  ||  _        _  ||    seats of the head bolts, seat_height
//      |                  ||_| |______| |_||    upper_deck
//      |                  ||      ||      ||    jacket, with a tower over each cylinder and a
//      |                  ||______||______||    bulkhead between two
//      +-- fire_deck      |_____------_____|    fire_deck, with a recess over each bore: roof_i
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

struct HeadParameters {
  int cylinders = 4;
  double bore = 107, cylinder_pitch = 130;
  double length = 545, width = 161, height = 110;
  double fire_deck = 14, jacket = 46, upper_deck = 10, wall = 7;
  double recess = 1.5;                // of the roofs, above the gasket's plane
  double bulkhead = 20;               // thickness, between the jackets of two cylinders
  double tower = 40;                  // diameter
  double bolt_reach = 63;             // of the head bolts, from the middle plane
  double seat = 24, seat_height = 8;  // diameter; above the upper deck

  double x_of_cylinder(int i) const { return (i - 0.5 * (cylinders - 1)) * cylinder_pitch; }
  double x_of_bolt(int k) const { return (k - 0.5 * cylinders) * cylinder_pitch; }
  double deck_top() const { return fire_deck + jacket + upper_deck; }
};

/// The keys of [head]; InputError for dimensions that do not fit together.
const keys::Keys<HeadParameters>& head_keys();

/// Region "head". Surfaces fire_deck, roof_i, cover_flange, bolt_1, bolt_2, ... (seats, by x: +y,
/// -y), outer (the four sides).
PartGeometry build_head(GmshSession& session, const HeadParameters& p);

}  // namespace clatter::mesh
