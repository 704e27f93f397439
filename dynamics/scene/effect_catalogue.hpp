// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The catalogue of all effects, as docs/effects.md has it.
#include <string>
#include <vector>

#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

/// The families in the order of the components.
const std::vector<EffectFamily>& effect_catalogue();

/// The tables of docs/effects.md: for each family a heading and a row for each effect.
std::string effect_tables();

}  // namespace clatter::dynamics
