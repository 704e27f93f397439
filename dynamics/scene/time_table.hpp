// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The tables [time] and [accuracy] of a scene.
#include "core/base/config.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Reads span, ramp and output of a scene whose clock, if it has one, is known. InputError for
/// values outside their range, which allows for 2 to 1e9 samples.
void read_time(const Config& root, Scene& scene);

/// Reads method, step limits and accuracy; after read_time() and the components, whose film decides
/// on the default method.
void read_steps(const Config& root, Scene& scene);

}  // namespace clatter::dynamics
