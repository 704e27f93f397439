// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Static results for --json.
#include "core/base/json_line.hpp"
#include "modal/statics.hpp"

namespace clatter::modal {

/// cases, their number, and results, one object per case: name, largest_displacement_m, energy_j,
/// backward_error, forward_error, balance, largest_von_mises_pa (null without cells), supports:
/// {name: [force N and moment N m about the origin]}, gaskets: {name: {area_m2, pressed_m2,
/// force_n, highest_pressure_pa, opening_m}} of those with curves.
JsonMembers json_of(const fe::FeModel& model, const StaticSolution& solution);

}  // namespace clatter::modal
