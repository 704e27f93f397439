// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The name that was probably meant.
#include <set>
#include <string>

namespace clatter {

/// The candidate with the fewest letters to change, add or remove; "" when none is near.
std::string nearest_name(const std::string& name, const std::set<std::string>& candidates);

}  // namespace clatter
