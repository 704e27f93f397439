// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Errors of a velocity map.
#include "recover/acoustic/velocity_map.hpp"

namespace clatter::recover {

/// Flux of the exposed faces for each displacement of a node: the shares of n dS of their points,
/// times the shape functions.
struct ExposedFlux {
  explicit ExposedFlux(Eigen::Index nodes)
      : sum(Eigen::VectorXd::Zero(3 * nodes)), amount(Eigen::VectorXd::Zero(3 * nodes)) {}
  void add(int32_t node, const Eigen::Vector3d& share) {
    sum.segment<3>(3 * node) += share;
    amount.segment<3>(3 * node) += share.cwiseAbs();
  }

  Eigen::VectorXd sum;     // 3 n_s [m2]; of the two sides of a sheet in air 0
  Eigen::VectorXd amount;  // 3 n_s [m2], of the absolute values
};

/// Measures a map with rigid motions of the body, turns weighed by its size.
MapErrors map_errors(const rom::Skin& skin, const sound::Surface& acoustic, const VelocityMap& map,
                     const ExposedFlux& flux);

}  // namespace clatter::recover
