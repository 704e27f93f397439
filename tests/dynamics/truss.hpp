// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An elastic body of point masses and springs, for the tests of large motion.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::dynamics::testing {

/// Point masses joined by springs without prestress: three displacements per node.
struct Truss {
  std::vector<Eigen::Vector3d> node;       // [m]
  std::vector<double> mass;                // [kg]
  std::vector<std::array<int, 2>> spring;  // nodes
  double stiffness = 0.0;                  // of each spring [N/m]

  int size() const { return 3 * static_cast<int>(node.size()); }
  /// Of linear elasticity, 3 n_nodes square [N/m].
  Eigen::MatrixXd stiffness_matrix() const;
  /// The integrals of the displacements of all nodes, as sums over the masses.
  rom::InertiaInvariants invariants() const;
  /// The body as a reduced model in which every displacement is a coordinate.
  rom::ReducedModel model() const;
};

/// An octahedron, rigid as a frame, with six different masses about 1 kg at a radius of about 0.2
/// m.
Truss octahedron(double stiffness);

}  // namespace clatter::dynamics::testing
