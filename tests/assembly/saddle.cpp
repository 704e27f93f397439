// SPDX-License-Identifier: GPL-3.0-or-later
#include "saddle.hpp"

#include "core/dense/least_squares.hpp"
#include "core/fe/assemble.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {

Saddle::Saddle(const mesh::Mesh& mesh, int points) {
  const fe::NodalMatrices nodal = fe::assemble(mesh, materials_of(mesh), fe::node_pattern(mesh));
  const Eigen::MatrixXd K = full(nodal.K);
  n_ = K.rows() + 6 * points;
  K_ = Eigen::MatrixXd::Zero(n_, n_);
  K_.topLeftCorner(K.rows(), K.cols()) = K;
}

void Saddle::add(const Functional& row, double value) {
  rows_.push_back(row);
  values_.push_back(value);
}

void Saddle::add(const Dependence& dependence) {
  Functional row = dependence.on;
  for (double& value : row.values) value = -value;
  row.dofs.push_back(dependence.dof);
  row.values.push_back(1.0);
  add(row);
}

Eigen::VectorXd Saddle::solve(const Eigen::VectorXd& f) const {
  const auto m = static_cast<Eigen::Index>(rows_.size());
  const double scale = K_.diagonal().maxCoeff();  // so that both blocks are comparable
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n_ + m, n_ + m);
  A.topLeftCorner(n_, n_) = K_ / scale;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n_ + m);
  b.head(n_) = f / scale;
  for (Eigen::Index r = 0; r < m; ++r) {
    const Functional& row = rows_[r];
    for (size_t k = 0; k < row.dofs.size(); ++k)
      A(n_ + r, row.dofs[k]) = A(row.dofs[k], n_ + r) += row.values[k];
    b(n_ + r) = values_[r];
  }
  // Unattached DoFs make A singular: the minimum norm solution is zero there, as without them.
  return dense::least_squares(A, b).X.col(0).head(n_);
}

}  // namespace clatter::assembly::testing
