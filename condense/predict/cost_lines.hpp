// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A predicted cost for people and for --json.
#include <string>
#include <vector>

#include "condense/predict/predicted_cost.hpp"
#include "core/base/json_line.hpp"

namespace clatter::condense {

std::vector<std::string> describe(const PredictedCost& cost);

/// For --json; docs/formats.md lists the members.
JsonMembers json_of(const PredictedCost& cost);

}  // namespace clatter::condense
