// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pressure at points of the fluid: microphones.
#include <Eigen/Core>
#include <string>

#include "core/sound/radiation.hpp"

namespace clatter::sound {

/// Throws InputError "<name>: found (x, y, z) m inside the body ..." for a point that is inside the
/// surface, nearer to it than a fiftieth of a mean edge, or below the ground plane.
void require_in_fluid(const Surface& surface, const Space& space, const std::string& name,
                      const Eigen::Vector3d& point);

/// p(x) = int ( p dG/dn(y) - G dp/dn ) dS at each point, of the surface and its image [Pa]; facets
/// nearer than three times their size are divided.
/// @param points n_p x 3 [m]
/// @return n_p x m
/// @throws InputError for a point outside the fluid
Eigen::MatrixXcd field_pressure(const Surface& surface, const Space& space,
                                const SurfaceState& state, const RowMatrix& points);

}  // namespace clatter::sound
