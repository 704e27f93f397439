// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// DoFs of reference nodes to which nothing is attached.
#include "assembly/constraint/elimination.hpp"
#include "assembly/constraint/part_data.hpp"
#include "assembly/constraint/relations.hpp"

namespace clatter::assembly {

/// Drops them, with a message, after all relations have been added. InputError for a node to which
/// nothing at all is attached, and for a DoF with mass that nothing holds.
void drop_unattached(const PartData& part, const Relations& relations, Eliminator& eliminator);

}  // namespace clatter::assembly
