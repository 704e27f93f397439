#include "condense/constraint_modes.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "core/progress.hpp"

namespace clatter::condense {

Eigen::MatrixXd constraint_modes(const modal::SupernodalFactor& factor_ii, const SparseMatrix& K_ib) {
  constexpr Eigen::Index kBlock = 64;
  Eigen::MatrixXd Psi(K_ib.rows(), K_ib.cols());
  Progress progress("constraint modes", static_cast<double>(K_ib.cols()));
  for (Eigen::Index first = 0; first < K_ib.cols(); first += kBlock) {
    const Eigen::Index count = std::min(kBlock, K_ib.cols() - first);
    const Eigen::MatrixXd load = K_ib.middleCols(first, count);
    Psi.middleCols(first, count) = -factor_ii.solve(load);
    progress.update(static_cast<double>(first + count));
  }
  return Psi;
}

double restore_rigid_motions(Eigen::MatrixXd& Psi_ib, const Eigen::MatrixXd& rigid_b,
                             const Eigen::MatrixXd& rigid_i) {
  if (rigid_b.cols() == 0) return 0.0;
  const Eigen::MatrixXd error = rigid_i - Psi_ib * rigid_b;
  // error r_b^+ is the change of least norm that maps r_b to error.
  const Eigen::MatrixXd inverse = rigid_b.completeOrthogonalDecomposition().pseudoInverse();
  Psi_ib.noalias() += error * inverse;
  return error.norm() / rigid_i.norm();
}

}  // namespace clatter::condense
