// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Static results as a JSON array.
#include <string>

#include "modal/statics.hpp"

namespace clatter::modal {

/// One object per case: name, largest_displacement_m, energy_j, residual, balance,
/// largest_von_mises_pa (null without cells), supports: {name: [force N and moment N m about the
/// origin]}.
std::string json_of(const fe::FeModel& model, const StaticSolution& solution);

}  // namespace clatter::modal
