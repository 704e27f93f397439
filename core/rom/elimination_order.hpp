// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The fill-reducing permutation of a factorisation, stored in an artefact for reuse.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/sparse.hpp"

namespace clatter::rom {

struct EliminationOrder {
  std::vector<int32_t> permutation;  // DoF eliminated at each step; empty: not known
  std::string pattern;               // sha256_of_pattern of the matrix that it was computed for
  std::string method;                // "metis", "amd", "natural", or "given" for a reused one
  int64_t entries = 0;               // of the factor

  bool fits(const SparseMatrix& lower) const;
};

/// Hash of a matrix's sparsity pattern, without values.
std::string sha256_of_pattern(const SparseMatrix& lower);

/// Writes group `ordering`; nothing when empty.
void write_elimination_order(H5File& file, const EliminationOrder& order);

/// Reads it from an artefact. Empty when there is no such file, when it contains none, or when that
/// is not a permutation: it is only needed to save time.
EliminationOrder read_elimination_order(const std::filesystem::path& path);

}  // namespace clatter::rom
