// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reference solution for all couplings: constrained minimisation by Lagrange multipliers, dense.
#include <Eigen/Core>
#include <vector>

#include "assembly/coupling/coupling.hpp"
#include "assembly/coupling/rigid_coupling.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly::testing {

/// Minimises 1/2 u^T K u - f^T u under rows u = 0 on all nodes' and points' DoFs; `points` DoFs
/// follow the nodes' and have no stiffness of their own.
class Saddle {
 public:
  Saddle(const mesh::Mesh& mesh, int points);

  /// sum values u[dofs] = value.
  void add(const Functional& row, double value = 0.0);
  /// u[dof] = on.
  void add(const Dependence& dependence);
  /// u over all DoFs for the forces f.
  Eigen::VectorXd solve(const Eigen::VectorXd& f) const;
  Eigen::Index size() const { return n_; }

 private:
  Eigen::MatrixXd K_;
  Eigen::Index n_;
  std::vector<Functional> rows_;
  std::vector<double> values_;
};

}  // namespace clatter::assembly::testing
