// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which unit systems there are, for messages and references.
#include <string>
#include <vector>

namespace clatter {

/// The names that unit_system_named() (core/base/units.hpp) knows.
std::vector<std::string> unit_system_names();

}  // namespace clatter
