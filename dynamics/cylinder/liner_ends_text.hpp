// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How far a skirt leaves its liner.
#include <string>

#include "dynamics/film/piston_liner_options.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// What the ideal stroke does at the ends of the liner: "skirt leaves its bottom by 16 mm, 133 to
/// 227 deg after TDC, stays 4 mm below its top". Empty for a liner without ends.
std::string liner_ends_text(const SliderCrank& crank, const film::PistonLinerOptions& contact);

}  // namespace clatter::dynamics
