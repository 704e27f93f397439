// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Partition of a model's DoFs into boundary (retained) and interior ones.
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "condense/basis/shared_part.hpp"
#include "core/base/sparse.hpp"
#include "core/fe/fe_model.hpp"
#include "core/fe/free_motions.hpp"

namespace clatter::condense {

/// Boundary DoFs b in the order of the reduced coordinates; interior DoFs i ascending, or those of
/// this process in the order of its rows.
struct DofPartition {
  std::vector<int32_t> boundary;            // n_b indices into the model
  std::vector<int32_t> interior;            // n_i indices into the model
  std::map<std::string, rom::DofSet> sets;  // the boundary sets; `dofs` index the reduced model
  std::map<std::string, rom::ContactGrid> grids;  // of those sets that are contact grids
  std::vector<std::string> repeated;              // labels of DoFs that were already retained
};

/// Boundary = the DoFs of the named sets, set by set. A DoF in several sets gets one shared
/// coordinate (hard case B3). InputError for an unknown or empty set, or when no interior DoF is
/// left.
DofPartition partition_dofs(const fe::FeModel& model, const std::vector<std::string>& set_names);

/// A symmetric matrix in blocks, A = [A_ii A_ib; A_bi A_bb]; of a shared part ib has the rows of
/// this process, and ii is empty.
struct PartitionedMatrix {
  SparseMatrix ii;     // n_i x n_i, lower triangle
  SparseMatrix ib;     // n_i x n_b
  Eigen::MatrixXd bb;  // n_b x n_b, both triangles
};

/// @param lower n x n, lower triangle.
PartitionedMatrix partition_matrix(const SparseMatrix& lower, const DofPartition& partition);

/// A model in blocks, constructed once and passed to every step of the reduction.
struct PartitionedModel {
  const fe::FeModel& full;
  DofPartition dofs;
  PartitionedMatrix K, M;                    // [N/m], [kg]
  fe::FreeMotions free;                      // rigid motions that the supports leave free
  std::shared_ptr<const SharedPart> shared;  // null: this process has all rows

  const sparse::RowTeam& team() const;
  /// (K_ii, M_ii); must not outlive this.
  std::shared_ptr<const sparse::MatrixPencil> interior() const;
  /// (K, M); the rows of the interior are rows interior_of_whole().
  std::shared_ptr<const sparse::MatrixPencil> whole() const;
  std::vector<int32_t> interior_of_whole() const;
  /// Rows of a matrix n x m, one for each DoF, in the order of whole().
  Eigen::MatrixXd rows_of_whole(const Eigen::MatrixXd& all) const;
};

/// Partitions a model by the named boundary sets. InputError as partition_dofs, and for a boundary
/// that leaves one of the free motions possible, naming the motion.
PartitionedModel partition_model(const fe::FeModel& model,
                                 const std::vector<std::string>& boundary);

/// InputError for a boundary that leaves one of the free motions possible, naming the motion.
void check_boundary_holds(const fe::FeModel& model, const DofPartition& partition,
                          const fe::FreeMotions& free);

}  // namespace clatter::condense
