// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The pattern of a stored matrix, without its values.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter::fe {

/// Columns [first, first + columns) of a stored lower triangle.
struct StoredColumns {
  int64_t first = 0;
  std::vector<int64_t> starts;  // columns + 1, from 0
  std::vector<int32_t> rows;    // ascending in each column
};

/// Reads the pattern of `count` columns of the matrix `group`, n x n. InputError with file, group
/// and column where it is not a lower triangle.
StoredColumns read_columns(const std::filesystem::path& path, const std::string& group, int64_t n,
                           int64_t first, int64_t count);

/// Patterns of the blocks of K; the values are zero.
struct StiffnessPattern {
  SparseMatrix ii;  // n_i x n_i, lower triangle
  SparseMatrix ib;  // n_i x n_b
};

/// @param interior ascending DoFs; boundary: all others.
StiffnessPattern read_stiffness_pattern(const std::filesystem::path& path,
                                        const std::vector<int32_t>& interior,
                                        const std::vector<int32_t>& boundary);

}  // namespace clatter::fe
