// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/local_part.hpp"

#include <numeric>
#include <utility>

#include "condense/basis/frame_inertia.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::condense {
namespace {

/// @param lower n x n, lower triangle.
PartitionedMatrix partition_matrix(const SparseMatrix& lower, const DofPartition& partition) {
  const auto n = static_cast<size_t>(lower.cols());
  const auto n_i = static_cast<int>(partition.interior.size());
  const auto n_b = static_cast<int>(partition.boundary.size());
  std::vector<int> block_index(n);
  std::vector<char> is_boundary(n, 0);
  for (int k = 0; k < n_i; ++k) block_index[partition.interior[k]] = k;
  for (int k = 0; k < n_b; ++k) {
    block_index[partition.boundary[k]] = k;
    is_boundary[partition.boundary[k]] = 1;
  }
  std::vector<Eigen::Triplet<double>> ii, ib;
  ii.reserve(lower.nonZeros());
  PartitionedMatrix blocks;
  blocks.bb = Eigen::MatrixXd::Zero(n_b, n_b);
  for (int j = 0; j < lower.outerSize(); ++j) {
    const bool column_b = is_boundary[j] != 0;
    const int q = block_index[j];
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      const bool row_b = is_boundary[it.row()] != 0;
      const int p = block_index[it.row()];
      if (row_b && column_b) {
        blocks.bb(p, q) = blocks.bb(q, p) = it.value();
      } else if (row_b) {
        ib.emplace_back(q, p, it.value());
      } else if (column_b) {
        ib.emplace_back(p, q, it.value());
      } else {
        ii.emplace_back(p, q, it.value());  // ascending indices keep p >= q
      }
    }
  }
  blocks.ii.resize(n_i, n_i);
  blocks.ii.setFromTriplets(ii.begin(), ii.end());
  blocks.ib.resize(n_i, n_b);
  blocks.ib.setFromTriplets(ib.begin(), ib.end());
  return blocks;
}

/// Each entry of `some` has one in `all`. Both have sorted columns.
bool covers(const SparseMatrix& all, const SparseMatrix& some) {
  for (Eigen::Index j = 0; j < some.cols(); ++j) {
    SparseMatrix::InnerIterator at(all, j);
    for (SparseMatrix::InnerIterator entry(some, j); entry; ++entry) {
      while (at && at.row() < entry.row()) ++at;
      if (!at || at.row() != entry.row()) return false;
    }
  }
  return true;
}

/// Zeros where only M has entries: the fronts of K carry the rows of M. So it is with the modes of
/// reduced parts and with matrices of other programs.
void cover(SparseMatrix& K, const SparseMatrix& M) {
  if (!covers(K, M)) K = SparseMatrix(K + 0.0 * M);
}

}  // namespace

LocalPart::LocalPart(const fe::FeModel& model, const std::vector<std::string>& boundary,
                     rom::EliminationOrder known)
    : PartitionedModel(model, boundary),
      known_(std::move(known)),
      interior_(K.ii, M.ii),
      whole_(model.K, model.M) {
  free = fe::free_motions(model);
  check_boundary_holds(model, dofs, free);
  K = partition_matrix(model.K, dofs);
  M = partition_matrix(model.M, dofs);
  cover(K.ii, M.ii);
  cover(K.ib, M.ib);
  whole_dofs.resize(model.size());
  std::iota(whole_dofs.begin(), whole_dofs.end(), 0);
  interior_of_whole = dofs.interior;
}

InteriorFactor LocalPart::factor_interior() const {
  sparse::FactorOptions options;
  if (known_.fits(K.ii))
    options.permutation.assign(known_.permutation.begin(), known_.permutation.end());
  const auto factor = std::make_shared<sparse::SupernodalFactor>(K.ii, K.ib, options);
  const std::vector<int64_t> permutation = factor->permutation();
  return {factor,
          {{permutation.begin(), permutation.end()},
           rom::sha256_of_pattern(K.ii),
           factor->report().ordering,
           factor->report().entries}};
}

rom::InertiaInvariants LocalPart::inertia(const ReducedBasis& basis) const {
  return frame_inertia(*this, basis);
}

}  // namespace clatter::condense
