// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/chain/small_motion.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace clatter::dynamics::testing {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SmallMotion small_motion(System& system, const VectorXd& y) {
  // A stage so long that dampers have no tangent.
  const Stage stage{0.0, 1e9, 1, {}};
  VectorXd force;
  system.evaluate(stage, y, VectorXd::Zero(y.size()), true, force);
  const auto n = static_cast<Eigen::Index>(system.interface_size());
  MatrixXd K(n, n);
  VectorXd unit = VectorXd::Zero(n), root(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    unit(j) = 1.0;
    force.setZero(n);
    system.add_tangent_forces(unit, force);
    K.col(j) = -force;
    unit(j) = 0.0;
    root(j) = std::sqrt(system.mobility({}, {static_cast<int>(j)}).v(0, 0));
  }
  const MatrixXd A = root.asDiagonal() * (0.5 * (K + K.transpose())) * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues().cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi),
          root.asDiagonal() * solver.eigenvectors()};
}

}  // namespace clatter::dynamics::testing
