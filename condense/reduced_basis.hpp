#pragma once
// A reduction basis and the projection of the model's matrices on it.
#include <Eigen/Core>
#include <vector>

#include "condense/dof_partition.hpp"

namespace clatter::condense {

/// q = V q_r in blocks: q_b = V_b q_r, q_i = V_i q_r. The first n_boundary columns belong to the
/// boundary coordinates.
struct ReducedBasis {
  Eigen::MatrixXd V_b;  // n_b x r
  Eigen::MatrixXd V_i;  // n_i x r
  int n_boundary = 0;

  Eigen::Index size() const { return V_i.cols(); }
};

/// V^T A V, r x r, symmetric: eq. (14) of the paper. A V is made for blocks of columns only.
Eigen::MatrixXd project(const PartitionedMatrix& A, const ReducedBasis& basis);

/// V^T f for a load f on all n DoFs of the model.
Eigen::VectorXd project_load(const Eigen::VectorXd& load, const DofPartition& partition,
                             const ReducedBasis& basis);

/// Columns that do not depend on those before them: column j is kept when what M leaves of it after
/// the kept ones are removed is more than `tolerance` of its own M-norm squared (hard case B3).
/// The first `protected_count` columns are always kept. Ascending indices.
/// @param M_rr r x r, the columns' Gram matrix in the mass inner product.
std::vector<int> independent_columns(const Eigen::MatrixXd& M_rr, int protected_count,
                                     double tolerance = 1e-12);

/// Keeps the named columns only.
void select_columns(ReducedBasis& basis, const std::vector<int>& kept);

}  // namespace clatter::condense
