// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A truck diesel's aluminium piston from its main dimensions.
//
// Piston frame: origin at the pin's centre, x along the pin, y toward the thrust side, z up. All
// lengths in the part's unit. The skirt is a plain cylinder of the bore's diameter: its barrel
// profile, ovality and clearance are micrometres and belong to the scene's gap, not to the mesh.
//
//      z    _____      ____  crown, compression_height above the pin
//      |   |     \____/    | bowl
//      |   |=  ring belt  =| grooves
//      |   |__  ______  ___| lower end of the belt = upper end of the skirt
//      |    | ||  pin ||  |  bosses, pin bore
//      +y   | | \____/ |  |  skirt on the thrust and antithrust side, panels to the bosses
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

struct PistonParameters {
  double diameter = 107, compression_height = 69.5, skirt_depth = 45;  // skirt's end below the pin
  double pin_offset = 0;  // of the pin's axis from the piston's toward the thrust side
  double bowl_diameter = 62, bowl_depth = 14, crown_thickness = 11;  // under the bowl
  double belt_wall = 12;                                             // inside the outer diameter
  double groove_depth = 4.5;
  std::vector<double> land_heights = {9.0, 7.0, 4.5, 4.0};  // from the crown down
  std::vector<double> groove_heights = {3.0, 2.5, 3.5};     // between the lands
  double skirt_wall = 5;
  double panel_distance = 41, panel_wall = 6;  // outer side of the panels in |x|
  double pin_diameter = 40, boss_diameter = 60, boss_gap = 34, pillar_width = 36;

  double belt_bottom() const;  // z of the belt's lower end
  double under_crown() const { return compression_height - bowl_depth - crown_thickness; }
};

/// The keys of [piston]; InputError for dimensions that do not fit together.
const keys::Keys<PistonParameters>& piston_keys();

/// Region "piston". Surfaces crown (all faces loaded by gas pressure; their resultant is
/// pi/4 diameter^2 in -z), skirt (outer faces of both sides below the belt), pin_bore.
PartGeometry build_piston(GmshSession& session, const PistonParameters& p);

}  // namespace clatter::mesh
