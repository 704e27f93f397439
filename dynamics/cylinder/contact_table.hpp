// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The [contact] table of a scene.
#include "core/base/config.hpp"
#include "dynamics/film/piston_liner_options.hpp"

namespace clatter::dynamics {

/// Reads [contact]; every key except `bore_mm` and the clearance has a default. `lubrication =
/// "none"` switches the film off. Heights are z from the pin's centre.
film::PistonLinerOptions read_contact(const Config& table);

}  // namespace clatter::dynamics
