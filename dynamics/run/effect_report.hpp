// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of a scene with what they cost, for the user.
#include <string>
#include <vector>

#include "core/base/json_line.hpp"
#include "dynamics/run/run_forecast.hpp"

namespace clatter::dynamics {

/// Lines of at most 120 columns: for each effect on or off, what it adds and costs, why, then its
/// equation, what it needs and what switches it on; last the seconds of the entire run.
std::vector<std::string> effect_lines(const RunForecast& forecast);

/// The same for --json: "effects", a list of objects with name, state, why, entry, equation, needs,
/// switch, unknowns, evaluations, seconds (null: not known), and numbers of the run.
JsonMembers effects_json(const RunForecast& forecast);

/// `text` in lines of at most `width` columns, each but the first after `indent` spaces.
std::vector<std::string> wrapped(const std::string& text, size_t width, size_t indent);

}  // namespace clatter::dynamics
