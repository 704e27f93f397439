// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The tables [time] and [accuracy] of a scene.
#include "core/base/config.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Ranges of displacement_um and velocity_m_s, of [accuracy] and of single bodies.
inline const Range kDisplacementScaleUm = Range::between(1e-15, 1e6);
inline const Range kVelocityScale = Range::between(1e-18, 1e4);

/// Reads span, ramp and output of a scene whose engine, if it has one, is known. InputError for
/// values outside their range, which allows for 2 to 1e9 samples.
void read_time(const Config& root, Scene& scene);

/// Reads method, step limits and accuracy; after read_time() and the contact, whose film decides on
/// the default method.
void read_steps(const Config& root, Scene& scene);

}  // namespace clatter::dynamics
