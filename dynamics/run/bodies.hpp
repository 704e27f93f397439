// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The reduced models of a scene, read once, with their modal bodies.
#include "dynamics/component/loaded_body.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Reads every body with a reduced model that the scene simulates (a rigid block is not
/// simulated). InputError for two bodies of one name.
LoadedBodies load_bodies(const Scene& scene);

}  // namespace clatter::dynamics
