// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The clearance between skirt and liner: as a number, or by the smallest gap of the warm surfaces.
#include <string>

#include "dynamics/component/effects.hpp"
#include "dynamics/film/piston_liner_options.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// The dead centres of the pin.
void set_stroke(const SliderCrank& crank, film::WarmClearance& warm);

/// Adds the row "minimum warm clearance", off where `clearance_um` is given: "on
/// contact.minimum_warm_clearance_um: 54.3 um of clearance between the cold surfaces, smallest warm
/// gap -20 mm above the pin, 0 deg around, 180 deg after TDC".
/// @param cylinder  its name; empty: the only one. @param contact  of the film element, whose
/// clearance follows from the gap.
void add_clearance_effect(const std::string& cylinder, const SliderCrank& crank,
                          const film::PistonLinerOptions& contact, EffectTable& effects);

}  // namespace clatter::dynamics
