// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The crankshaft of a scene, as all its cylinders see it.
#include <optional>

#include "core/keys/keys.hpp"
#include "dynamics/body/crank_body.hpp"

namespace clatter::dynamics {

/// speed, mass_kg, polar_kg_m2, diametral_kg_m2 and centre_mm of [crank], which is in bearings
/// where it has [[crank.bearing]]. InputError for one that is neither in bearings nor free, for the
/// masses that it needs, and for moments that no body has.
const keys::Keys<CrankBody>& crank_body_keys();

/// Of a scene `root`; none without [crank].
std::optional<CrankBody> read_crank_body(const Config& root);

}  // namespace clatter::dynamics
