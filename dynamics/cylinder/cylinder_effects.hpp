// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of a cylinder, on and off, with the keys that decide.
#include <string>

#include "dynamics/component/component.hpp"
#include "dynamics/component/effects.hpp"
#include "dynamics/cylinder/cylinder_spec.hpp"

namespace clatter::dynamics {

/// Adds all effects in the order in which they are reported; those of a named cylinder begin with
/// its name. @param size of its bodies and film. @param on_block the block is elastic. @param ends
/// how the skirt passes those of the liner (liner_ends_text); empty: it has none
void add_cylinder_effects(const CylinderSpec& cylinder, const ComponentTraits& traits,
                          bool on_block, const std::string& ends, EffectTable& effects);

}  // namespace clatter::dynamics
