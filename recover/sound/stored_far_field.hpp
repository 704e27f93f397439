// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The far field of a part as a sound file keeps it.
#include <Eigen/Core>

#include "core/base/matrix.hpp"
#include "core/sound/space.hpp"

namespace clatter::recover {

/// G without the highest degrees, which hold less than 1e-6 of the power of every coordinate, and
/// rounded to single precision: what is written is what R is made of.
/// @param of_flow (degree + 1)^2 x n_v, sound::FarHarmonics::of_flow
/// @param flow Q, n_v x r, of all coordinates
Eigen::MatrixXcd stored_far_field(const Eigen::MatrixXcd& of_flow, const RowMatrix& flow);

/// R = Re( (G Q)^H G Q ) / (rho c), half of it above a ground plane: r x r, symmetric, positive
/// semidefinite.
Eigen::MatrixXd far_field_resistance(const sound::Space& space, const Eigen::MatrixXcd& far,
                                     const RowMatrix& flow);

}  // namespace clatter::recover
