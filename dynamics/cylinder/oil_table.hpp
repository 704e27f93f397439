// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The oil of a contact: tables [contact.oil] and [contact.liner_oil] of a scene.
#include "core/base/config.hpp"
#include "dynamics/film/piston_liner_options.hpp"

namespace clatter::dynamics {

/// Reads laws of the viscosity from [contact.oil]; `contact` is [contact]. Absent: it is constant.
void read_viscosity(const Config& contact, film::PistonLinerOptions& options);

/// Reads the layer that is remembered on the liner from [contact.liner_oil], after the other keys
/// of the oil and the effects; absent: there is none.
void read_liner_oil(const Config& contact, film::PistonLinerOptions& options);

}  // namespace clatter::dynamics
