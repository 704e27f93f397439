// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The radial clearance that leaves a given smallest gap between warm surfaces.
#include "dynamics/film/cover.hpp"

namespace clatter::film {

struct PistonLinerOptions;

/// Smallest gap that a scene asks for, and the range of the stroke in which it occurs.
struct WarmClearance {
  double minimum = 0.0;                        // the gap [m], >= 0
  double lowest_pin = 0.0, highest_pin = 0.0;  // engine z of the pin at the dead centres [m]
};

/// Where the surfaces of skirt and liner are nearest to each other.
struct NearestPoint {
  double gap = 0.0;     // without the clearance: relief - skirt's shapes + liner's shapes [m]
  double angle = 0.0;   // on the pads, from the thrust side right-handed about z [rad]
  double height = 0.0;  // z from the pin's centre [m]
  double pin = 0.0;     // engine z of the pin [m]
};

/// Smallest gap of the centred, upright, unloaded piston over its stroke, inside the ends of the
/// liner, sampled on both pads: every millimetre along skirt and stroke, every 2 degrees around.
///
///   min over (f, z, z_B) of  relief(f, z) - skirt shapes(f, z) + liner shapes(f, z_B + z)
///
/// The clearance that leaves the gap c_min is c_min - gap. Linear shapes have an error of at most
/// half a millimetre times their slope. InputError when no point of the skirt is inside the ends.
NearestPoint nearest_point(const PistonLinerOptions& options, const WarmClearance& warm);

}  // namespace clatter::film
