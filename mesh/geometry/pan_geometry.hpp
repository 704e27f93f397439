// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An oil pan of sheet from its main dimensions, all to the middle of the sheet, in the part's unit.
//
//        flange           flange
//      z ____              ____    z = 0: the flange
//      | '   `.          .'   '    flange_fillet between flange and walls
//      |      |          |         walls: length along x, width along y, rounded by `corner`
//      +x     `._________.'        bottom_fillet; the bottom at z = -depth, or -sump_depth over
//                                  sump_length at the end of +x
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

struct PanParameters {
  double length = 300, width = 200, depth = 60, thickness = 1.5;
  double corner = 40, bottom_fillet = 12;
  double flange = 20, flange_fillet = 6;       // flange: from the walls to its edge
  double sump_depth = 0.0, sump_length = 0.0;  // 0: no sump
  std::string region = "pan";
  SheetCells cells = SheetCells::kQuadrilaterals;
};

/// The keys of [pan]; InputError for dimensions that do not fit together.
const keys::Keys<PanParameters>& pan_keys();

/// Surfaces flange, bottom (and sump). Outward is down, out of the oil.
PartGeometry build_pan(GmshSession& session, const PanParameters& p);

}  // namespace clatter::mesh
