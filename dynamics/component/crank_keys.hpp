// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The crankshaft of a scene, as all its cylinders see it.
#include <optional>

#include "core/base/config.hpp"
#include "dynamics/body/crank_body.hpp"

namespace clatter::dynamics {

/// speed, mass_kg, polar_kg_m2, diametral_kg_m2 and centre_mm of [crank], of a scene `root`;
/// without that table none. It is in bearings where it has [[crank.bearing]]. InputError for one
/// that is neither, for the masses that it needs, and for moments that no body has.
std::optional<CrankBody> read_crank_body(const Config& root);

}  // namespace clatter::dynamics
