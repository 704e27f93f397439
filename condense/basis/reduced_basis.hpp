// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A reduction basis and the projection of the model's matrices on it.
#include <Eigen/Core>
#include <memory>

#include "condense/basis/partitioned_model.hpp"
#include "condense/basis/static_reduction.hpp"
#include "core/sparse/factor/factor.hpp"

namespace clatter::condense {

/// V = [I 0; Psi X]: constraint modes Psi = -K_ii^{-1} K_ib, which are never stored (n_i x n_b is
/// the largest matrix of a condensation) but applied through the factor, and shapes X of the
/// interior.
class ReducedBasis {
 public:
  ReducedBasis() = default;
  /// @param part must outlive this.
  ReducedBasis(const PartitionedModel& part, std::shared_ptr<const sparse::Factor> factor_ii);

  Eigen::MatrixXd shapes;  // X, n_i x k

  Eigen::Index boundary() const { return part_->K.ib.cols(); }
  Eigen::Index size() const { return boundary() + shapes.cols(); }
  /// Interior rows of V q; q is r x m.
  Eigen::MatrixXd interior(const Eigen::Ref<const Eigen::MatrixXd>& q) const;
  /// The first n_b rows of V^T f.
  Eigen::MatrixXd at_boundary(const Eigen::Ref<const Eigen::MatrixXd>& f_i,
                              const Eigen::Ref<const Eigen::MatrixXd>& f_b) const;
  /// V^T f for loads f_i (n_i x m) and f_b (n_b x m).
  Eigen::MatrixXd project(const Eigen::Ref<const Eigen::MatrixXd>& f_i,
                          const Eigen::Ref<const Eigen::MatrixXd>& f_b) const;
  /// V^T A V of a symmetric matrix on all DoFs, lower triangle; r x r, both triangles. Three half
  /// solves for each boundary coordinate. Of one process.
  Eigen::MatrixXd congruence(const SparseMatrix& A) const;

 private:
  const PartitionedModel* part_ = nullptr;
  std::shared_ptr<const sparse::Factor> factor_;
};

/// The matrices on the basis, eq. (14) of the paper.
struct ReducedMatrices {
  Eigen::MatrixXd M_rr, K_rr;  // r x r, symmetric, both triangles
};

/// V^T A V from the boundary blocks of the static sweep; columns of X are processed in blocks. Psi
/// and X are orthogonal in K.
ReducedMatrices project(const PartitionedModel& part, const StaticReduction& statics,
                        const ReducedBasis& basis);

}  // namespace clatter::condense
