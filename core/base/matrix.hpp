// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Row-major matrices, as stored in files.
#include <Eigen/Core>
#include <cstdint>

namespace clatter {

/// Row-major integer matrix: connectivity tables, (rows, columns) as in the file.
using IndexMatrix = Eigen::Matrix<int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// Row-major double matrix: coordinates (n, 3), histories (n_t, n_columns).
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace clatter
