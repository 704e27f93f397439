// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Projects eigenvectors that are known in advance out of an operator.
#include <Eigen/Core>

#include "core/sparse/eigen/matrix_pencil.hpp"
#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

/// Rigid-body motions U with K U = 0, U^T M U = 1. With P = 1 - U U^T M the operator P (K - sigma
/// M)^{-1} M has the same other eigenpairs, and 0 instead of -1 / sigma for those of U, however
/// small the shift.
class KnownMotions {
 public:
  /// @param U n x m, M-orthonormal, rows in the order of the problem; @param MU M U.
  KnownMotions(Eigen::MatrixXd U, Eigen::MatrixXd MU, const RowTeam& team = one_process());
  Eigen::Index count() const { return U_.cols(); }
  const Eigen::MatrixXd& vectors() const { return U_; }
  /// x <- P x for `count` row-major vectors, n x count; bitwise reproducible for any number of
  /// threads.
  void remove(double* x, int count) const;

 private:
  Eigen::MatrixXd U_, MU_;
  const RowTeam& team_;
};

/// A basis of span(R) with U^T M U = 1, M that of `pencil`; R n x m, of full rank in M.
Eigen::MatrixXd orthonormal_in_mass(const MatrixPencil& pencil, const Eigen::MatrixXd& R);

}  // namespace clatter::sparse
