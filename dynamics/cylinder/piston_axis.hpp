// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Agreement of the pin's offset with the geometry of the reduced piston.
#include "dynamics/cylinder/cylinder_bodies.hpp"

namespace clatter::dynamics {

/// The reduced piston, whose frame is at the pin, contains the offset of its pin: its skirt, and
/// the line of action of the gas, are on the bore's axis. A piston centred on an offset pin would
/// lack the moment of the gas about the pin. InputError naming engine.pin_offset_mm when the
/// skirt's axis is elsewhere (where the model has a skirt, rigid or not), or the gas load of a
/// model without skirt on an offset pin.
void check_piston_axis(const CylinderBodies& bodies);

}  // namespace clatter::dynamics
