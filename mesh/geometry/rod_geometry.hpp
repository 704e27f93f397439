// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A connecting rod from its main dimensions.
//
// Rod frame: origin at the big end's centre, x along the crankshaft, z to the small end. All
// lengths in the part's unit. Cap and bolts are one piece with the rod, bearing shells are not part
// of it.
//
//      z    .--.     small_outer, small_bore, small_width along x
//      |   ( () )
//      |    |  |     shank: shank_top at the small end, shank_bottom at the big end,
//      |    |  |     shank_thickness along x, with a pocket on both faces that leaves
//      |   .|  |.    flanges of width `flange` and a web of thickness `web`
//      |  (  ()  )
//      +y  `----'    big_outer, big_bore, big_width along x
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

struct RodParameters {
  double length = 210;  // between the centres
  double big_bore = 76, big_outer = 108, big_width = 34;
  double small_bore = 40, small_outer = 60, small_width = 28;
  double shank_bottom = 46, shank_top = 32, shank_thickness = 24;
  double flange = 7, web = 8;  // web = shank_thickness: no pockets
};

/// The keys of [rod]; InputError for dimensions that do not fit together.
const keys::Keys<RodParameters>& rod_keys();

/// Region "rod". Surfaces big_bore, small_bore.
PartGeometry build_rod(GmshSession& session, const RodParameters& p);

}  // namespace clatter::mesh
