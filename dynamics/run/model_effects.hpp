// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of a scene, on and off, with the keys that decide.
#include <cstddef>
#include <string>

#include "dynamics/run/scene_bodies.hpp"
#include "dynamics/scene/effects.hpp"

namespace clatter::dynamics {

/// All effects in the order in which they are reported. @param mounts in the model; @param ends how
/// the skirt passes those of the liner (liner_ends_text); empty: it has none
EffectTable effects_of(const SceneBodies& bodies, size_t mounts, const std::string& ends);

}  // namespace clatter::dynamics
