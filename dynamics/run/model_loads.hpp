// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The known forces of a scene: gas, inertia of moving frames, gravity, [[load]].
#include <optional>
#include <vector>

#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"
#include "dynamics/run/scene_bodies.hpp"

namespace clatter::dynamics {

/// Absolute pressure over the crank angle [Pa] of a scene with [gas].
std::optional<Spline> gas_pressure(const Scene& scene);

/// Every load on the bodies in `system`. All of them grow from zero over `time.ramp` at the start,
/// as (3 s^2 - 2 s^3), so that the motion can start from rest at its ideal position. InputError for
/// bodies, unit loads and sets that do not exist.
/// @param crank of an engine scene. @param gas its pressure, when it has one.
std::vector<Load> loads_of(const SceneBodies& bodies, const System& system,
                           const std::optional<SliderCrank>& crank,
                           const std::optional<Spline>& gas);

}  // namespace clatter::dynamics
