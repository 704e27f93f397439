// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An assembled part whose matrices are read in parts, each row by its owner.
#include <filesystem>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "core/fe/free_motions.hpp"
#include "core/ranks/mumps_factor.hpp"
#include "core/ranks/shared_matrix.hpp"
#include "core/ranks/shared_pencil.hpp"
#include "core/rom/elimination_order.hpp"

namespace clatter::ranks {

/// DoFs of a part in elimination order, the boundary last.
struct Numbering {
  std::vector<int32_t> dof;      // n: DoF at each index
  std::vector<int32_t> index;    // n: index of each DoF
  int64_t boundary = 0;          // the last ones
  rom::EliminationOrder stored;  // of the interior, for the file
};

/// Nested dissection of the interior, computed by rank 0, which reads the pattern of K for it; or
/// `known`, where it fits.
/// @param interior ascending DoFs; @param boundary all others.
Numbering number_dofs(const Ranks& ranks, const std::filesystem::path& path,
                      const std::vector<int32_t>& interior, const std::vector<int32_t>& boundary,
                      const rom::EliminationOrder& known);

/// K and M of a part: the rows of this rank.
struct SharedMatrices {
  Entries K, M;
};

/// Reads both: each rank reads some columns, checks them as read_fe_model does, and sends the
/// entries to the owners of their rows. InputError names file, dataset and column.
SharedMatrices read_matrices(const Ranks& ranks, const std::filesystem::path& path,
                             const Numbering& numbering, const RowShares& shares);

/// Rows of a part: all, in the order of its DoFs, or those of the interior, in the order in which
/// number_dofs got them.
struct PartRows {
  Extent extent = Extent::kWhole;
  const Numbering& numbering;

  const std::vector<int32_t>& places() const {  // by index in elimination order
    return extent == Extent::kWhole ? numbering.dof : numbering.stored.permutation;
  }
};

/// The free rigid-body motions of these rows, n x m, complete on every rank.
/// @param pencil of these rows and matrices.
/// @param rigid n x 6, unit rigid-body motions of these rows.
fe::FreeMotions free_motions(const Ranks& ranks, const SharedMatrices& matrices,
                             const RowShares& shares, const PartRows& rows,
                             const SharedPencil& pencil, const Eigen::MatrixXd& rigid);

}  // namespace clatter::ranks
