// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The block of an inline engine from its main dimensions: with wet liners like a truck diesel's, or
// with the bores in the casting like a passenger car's; on request with a timing side and a head.
//
// Engine frame: x along the crankshaft, y toward the thrust side, z up; origin on the crank axis in
// the middle between the first and the last cylinder. Cylinder 1 has the most negative x.
// All lengths in the part's unit; defaults in millimetres of a 4.7 litre four-cylinder engine.
//
//        z                 deck plate ============ deck_height
//        |               scallop | jacket | liner | bore ...       head bolt columns between
//        |                       |________|       |                cylinders
//        |      crankcase_top ___/  lower deck    | _____ crankcase roof; liners end below
//        |                   /                      \            .
//        |  shoulder_height |   chamber, bearing     |           mount pads outside
//        +---- crank axis   |   walls with bosses    |
//                           |                        |
//                       ====|                        |==== pan flange at -skirt_depth
#include <optional>

#include "mesh/geometry/part_geometry.hpp"
#include "mesh/geometry/timing_side.hpp"

namespace clatter::mesh {

struct BlockParameters {
  int cylinders = 4;
  // Parent bores: walls of thickness liner_wall are part of the casting, joined where those of two
  // cylinders meet, and end at the crankcase's roof. Bearing walls that reach below the bores are
  // relieved where the pistons pass. Key bores = "wet_liner" (default) or "parent".
  bool parent_bores = false;
  double bore = 107, stroke = 130, rod_length = 210;  // diameter; full stroke; centre to centre
  double cylinder_pitch = 130;                        // distance between neighbouring cylinder axes
  double deck_height = 345, deck_thickness = 16;      // above the crank axis; of the top plate
  double deck_overhang = 4;                           // of the plate over the housing's walls
  double liner_wall = 7, liner_length = 230;
  double liner_protrusion = 10;                     // below the lower deck, free in the chamber
  double jacket_thickness = 9, jacket_depth = 185;  // water around the liner; below the deck plate
  double outer_wall = 6, end_wall = 8;              // housing around the jacket; front and rear
  double column_width = 22, column_reach = 72;      // head bolt columns: along x; to |y|
  double crankcase_half_width = 128, crankcase_wall = 7;
  double shoulder_height = 70, crankcase_top = 150;  // slope of the crankcase between these heights
  double skirt_depth = 80;                           // pan flange below the crank axis
  double flange_width = 16, flange_thickness = 12;
  double bearing_wall = 20, bearing_wall_bottom = -20;  // thickness; lower edge (z) of inner walls
  double bearing_bore = 84, bearing_boss = 124, bearing_width = 30;   // diameters; length along x
  double mount_length = 70, mount_height = 60, mount_thickness = 14;  // pads along x, z, y
  std::optional<TimingSide> timing = {};                              // table [block.timing]

  double x_of_cylinder(int i) const { return (i - 0.5 * (cylinders - 1)) * cylinder_pitch; }
  double x_of_bearing(int k) const { return (k - 0.5 * cylinders) * cylinder_pitch; }
  double liner_radius() const { return 0.5 * bore + liner_wall; }
  double jacket_radius() const { return liner_radius() + jacket_thickness; }
  double housing_radius() const { return jacket_radius() + outer_wall; }
  double half_length() const { return x_of_cylinder(cylinders - 1) + jacket_radius() + end_wall; }
  double liner_bottom() const { return deck_height - liner_length; }
  double roof() const {  // of the crankcase chambers
    return parent_bores ? liner_bottom() : liner_bottom() + liner_protrusion;
  }
  // Relief of the bearing walls around parent bores: its radius; where the piston is lowest.
  double relief_radius() const { return 0.52 * bore; }
  double relief_bottom() const { return rod_length - 0.5 * stroke - 0.5 * bore; }
  bool has_relief() const {
    return parent_bores && cylinder_pitch - bearing_wall <= bore && relief_bottom() < roof();
  }
  double jacket_top() const { return deck_height - deck_thickness; }
  double jacket_bottom() const { return jacket_top() - jacket_depth; }
};

/// The keys of [block]; InputError for dimensions that do not fit together.
const keys::Keys<BlockParameters>& block_keys();

/// Regions "block" and "liner" (conformal; without it where bores are parent). Surfaces
/// liner_i_bore, head_i (top face of liner i, where the gasket presses), bearing_k, mount_1..4
/// (front thrust, front antithrust, rear thrust, rear antithrust), pan_flange, deck, outer (exposed
/// to air: without deck, pan flange, jackets, bores and crankcase). Parent bores have no head_i.
/// With a timing side the head is part of the block: head_i is the roof of cylinder i, there is no
/// deck, and timing_surfaces() are added.
PartGeometry build_block(GmshSession& session, const BlockParameters& p);

}  // namespace clatter::mesh
