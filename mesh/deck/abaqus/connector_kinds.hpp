// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What connections of connector elements constrain, and which relative motions they have.
#include "mesh/deck/abaqus/fields.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck::abaqus {

/// The element type of all connections.
inline constexpr const char* kConnector = "CONN3D2";

/// Relative motions of the second node in axes of the first one: bits 0 to 2 along them, 3 to 5
/// about them.
struct ConnectorKind {
  DofMask constrained = 0, available = 0;
  bool along_line = false;  // component 1 is the distance of the nodes
  bool mean_axes = false;   // the axes turn by the mean rotation of both nodes

  DofMask components() const { return static_cast<DofMask>(constrained | available); }
  /// No component depends on the axes of the second node.
  bool rotations_are_alike() const {
    const int turns = constrained >> 3;
    return (turns == 0 || turns == 7) && available >> 3 == 0;
  }
};

/// The kind of one assembled connection, or of a translational and a rotational one. InputError for
/// connections that are not linear at first, with what replaces them.
ConnectorKind connector_kind(const Fields& types);

}  // namespace clatter::mesh::deck::abaqus
