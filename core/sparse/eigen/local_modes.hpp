// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The modes of a substructure: the largest eigenvalues of its diagonal block of an operator.
#include <Eigen/Core>
#include <functional>

namespace clatter::sparse {

/// A symmetric operator on the unknowns of a substructure.
struct LocalOperator {
  /// (Q, W, C): W = A Q, n x b; C = coupling of Q to the interior modes, inside x b.
  using Apply =
      std::function<void(const Eigen::MatrixXd& Q, Eigen::MatrixXd& W, Eigen::MatrixXd& C)>;
  Eigen::Index size = 0;    // n
  Eigen::Index inside = 0;  // modes of the substructures in its subtree
  Apply apply;
};

struct LocalModes {
  Eigen::MatrixXd vectors;   // n x k, orthonormal
  Eigen::VectorXd values;    // nu, descending
  Eigen::MatrixXd coupling;  // inside x k
};

struct LocalOptions {
  double cut = 0.0;        // modes with nu >= cut are wanted
  Eigen::Index block = 8;  // vectors that the operator processes at a time
  uint64_t seed = 1;       // of the start block
};

/// Block Lanczos with full orthogonalisation until the wanted modes are accurate to 1 % of nu:
/// they only have to span the space. Small blocks: all modes, by dense algebra.
LocalModes local_modes(const LocalOperator& A, const LocalOptions& options);

}  // namespace clatter::sparse
