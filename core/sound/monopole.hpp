// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A point source inside a body: its normal velocity on the surface radiates its known power, which
// checks normals, areas, phases and the mesh.
#include <Eigen/Core>
#include <optional>

#include "core/sound/radiation.hpp"

namespace clatter::sound {

/// A position inside the surface, of a grid over its bounding box the one that is farthest from it.
/// None when each is nearer to it than `least` [m]: the velocity that a source has on a face grows
/// with the inverse square of its distance, and larger faces do not resolve it.
std::optional<Eigen::Vector3d> inner_point(const Surface& surface, double least);

/// The source p = exp(-i k r) / r [Pa], with its image at the ground plane.
struct MonopoleMotion {
  Eigen::VectorXcd velocity;  // 3 n_f [m/s]: -dp/dn / (i omega rho), projected on each face
  double power;               // [W]: 2 pi / (rho c), times 1 + sin(2 k h) / (2 k h) at height h
};
MonopoleMotion monopole(const Surface& surface, const Space& space, double frequency_hz,
                        const Eigen::Vector3d& position);

}  // namespace clatter::sound
