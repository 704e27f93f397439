// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a reduced model is, for the user.
#include <string>
#include <vector>

#include "core/base/json_line.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// Lines for the user on the contents of the reduced model and what was verified.
std::vector<std::string> describe(const rom::ReducedModel& reduced);

/// For --json: method, boundary, size, valid_to_hz, count_proved, rigid_modes (null where they were
/// not counted), certified.
JsonMembers json_of(const rom::ReducedModel& reduced);

}  // namespace clatter::condense
