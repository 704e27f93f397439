// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An assembled part whose matrices are read in parts, each row by its owner.
#include <filesystem>
#include <vector>

#include "core/ranks/shared_matrix.hpp"
#include "core/rom/elimination_order.hpp"

namespace clatter::ranks {

/// DoFs of a part in elimination order, the boundary last.
struct Numbering {
  std::vector<int32_t> dof;      // n: DoF at each index
  std::vector<int32_t> index;    // n: index of each DoF
  rom::EliminationOrder stored;  // of the interior, for the file
};

/// K and M of a part: the rows of this rank.
struct SharedMatrices {
  /// Orders the interior by nested dissection, or as `known`, where it fits, and reads both
  /// matrices: each rank reads some columns, checks them as read_fe_model does, and sends the
  /// entries to the owners of their rows. InputError names file, dataset and column.
  /// @param interior ascending DoFs; @param boundary all others. @param all must outlive this.
  SharedMatrices(const Ranks& all, const std::filesystem::path& path,
                 const std::vector<int32_t>& interior, const std::vector<int32_t>& boundary,
                 const rom::EliminationOrder& known);

  const Ranks& ranks;
  Numbering numbering;
  RowShares shares;
  Entries K, M;
};

}  // namespace clatter::ranks
