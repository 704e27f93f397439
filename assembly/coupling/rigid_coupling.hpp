// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rigid couplings (RBE2): nodes and points that follow a reference node as a rigid body.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "assembly/coupling/coupling.hpp"
#include "assembly/coupling/dof_numbers.hpp"

namespace clatter::assembly {

/// Ids and position of a reference node's DoFs x y z rx ry rz.
struct ReferenceDofs {
  std::array<int32_t, 6> ids{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// One dependence u[dof] = on.
struct Dependence {
  int32_t dof = -1;
  Functional on;
};

/// The owner's DoFs in `directions` (0 ... 5; nodes have no rotations, which are skipped):
///   u = u_ref + theta_ref x (x - x_ref),  theta = theta_ref.
std::vector<Dependence> rigid_dependences(const DofNumbers& numbers, NodeOrPoint owner,
                                          const std::vector<int>& directions,
                                          const ReferenceDofs& reference);

}  // namespace clatter::assembly
