// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Directions of a deck's coordinate systems.
#include <Eigen/Core>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// The directions at position `x`, as columns: x y z, or radial, tangential, axial, or radial,
/// along the meridian away from the axis, along the parallel. On the axis of a curved system, where
/// they are not defined, those at its zero angle.
Eigen::Matrix3d axes_at(const System& system, const Eigen::Vector3d& x);

}  // namespace clatter::mesh::deck
