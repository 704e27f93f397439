// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shapes of guides and arms.
#include "core/base/config.hpp"
#include "dynamics/chain/chain_spec.hpp"

namespace clatter::dynamics {

/// The profile of a guide by its tables [[segment]], each with one of the keys line, arc, bezier,
/// points, in running direction of the chain, and the circles by which a taut chain passes it with
/// the pins' line `height` [m] from the profile. The solid is on the side around which the chain
/// turns.
void read_guide(const Config& table, double height, ChainOver& over);

}  // namespace clatter::dynamics
