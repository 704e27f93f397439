// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The known forces of a scene: gas, inertia of moving frames, gravity, [[load]].
#include <functional>
#include <map>
#include <string>

#include "dynamics/run/model.hpp"

namespace clatter::dynamics {

/// Indices of the bodies in the model's system, by name ("piston", "block", "rod", ...).
using BodyIndex = std::map<std::string, int>;

/// Adds every load to model.system. All of them grow from zero over `time.ramp` at the start, as
/// (3 s^2 - 2 s^3), so that the motion can start from rest at its ideal position.
void add_loads(const Scene& scene, const LoadedBodies& bodies, const BodyIndex& index,
               Model& model);

}  // namespace clatter::dynamics
