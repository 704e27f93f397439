// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Errors of a velocity map.
#include "recover/acoustic/velocity_map.hpp"

namespace clatter::recover {

/// Measures a map with rigid motions of the body, turns weighed by its size.
/// @param flux 3 n_s, sum over points: their share of n dS times the shape functions, so that
///        flux . u is the flux of the exposed faces [m2]
MapErrors map_errors(const rom::Skin& skin, const sound::Surface& acoustic, const VelocityMap& map,
                     const Eigen::VectorXd& flux);

}  // namespace clatter::recover
