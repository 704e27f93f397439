// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rayleigh damping of materials and steps: D = alpha M + beta K.
#include <optional>

#include "mesh/deck/abaqus/card.hpp"

namespace clatter::mesh::deck::abaqus {

/// Of *DAMPING or *GLOBAL DAMPING (parameters), or *MODAL DAMPING with RAYLEIGH (first data line:
/// lowest and highest mode, alpha, beta). None without alpha and beta, for TABULAR ones and those
/// of acoustic fields. InputError for what is no number.
std::optional<Damping> rayleigh_of(const Card& card, const Source& source);

}  // namespace clatter::mesh::deck::abaqus
