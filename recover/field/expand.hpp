// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Expansion of reduced coordinates to the skin, by blocks of columns.
#include <Eigen/Core>
#include <functional>

#include "core/base/matrix.hpp"

namespace clatter::recover {

/// Receives columns [first, first + u.cols()) of the expansion, 3 n_s x block.
using ExpansionSink = std::function<void(int64_t first, const Eigen::MatrixXd& u)>;

/// Expands u = T q for the columns of `reduced` (instants, or real parts of frequency lines).
///
/// Only `block` columns of the expansion are in memory at a time: 3 n_s x block doubles.
/// @param T 3 n_s x r, row 3 a + d: node a, direction d
/// @param reduced r x m
void expand(const RowMatrix& T, const Eigen::MatrixXd& reduced, int64_t block,
            const ExpansionSink& sink);

/// Number of columns that fit in about 64 MB for a skin of this many rows, at least 1.
int64_t expansion_block(int64_t rows);

}  // namespace clatter::recover
