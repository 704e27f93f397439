// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// DoFs of reference nodes to which nothing is attached.
#include "assembly/constraint/elimination.hpp"
#include "assembly/constraint/generalised.hpp"
#include "assembly/constraint/part_data.hpp"
#include "assembly/constraint/relations.hpp"

namespace clatter::assembly {

/// Drops them, with a message, after all relations have been added: entire DoFs, and the rotation
/// about the line of two linked nodes in any direction: the rotations of the reference become
/// theta = sum t_k q_k of new coordinates, t_k normal to the axes about which they move nothing.
/// InputError for a node to which nothing at all is attached, and for a DoF with mass that nothing
/// holds. Returns the motions of the new coordinates.
Motions drop_unattached(const PartData& part, const Relations& relations, Eliminator& eliminator);

}  // namespace clatter::assembly
