#pragma once
// Matrices row by row, as files hold them.
#include <Eigen/Core>
#include <cstdint>

namespace clatter {

/// Integer matrix stored row by row: connectivity tables, (rows, columns) as in the file.
using IndexMatrix = Eigen::Matrix<int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// Double matrix stored row by row: coordinates (n, 3), histories (n_t, n_columns).
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace clatter
