// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Expansion of reduced coordinates to the skin, by blocks of rows and columns.
#include <Eigen/Core>
#include <functional>

#include "core/rom/skin_rows.hpp"

namespace clatter::recover {

/// Rows and columns of the expansion that are in memory at a time.
struct ExpansionBlock {
  int64_t rows = 0, columns = 0;
};

/// Receives rows [row, row + u.rows()) of columns [column, column + u.cols()) of the expansion.
using ExpansionSink = std::function<void(int64_t row, int64_t column, const Eigen::MatrixXd& u)>;

/// Expands u = T q for the columns of `reduced` (instants, or parts of complex lines).
///
/// Each block of rows of T is read once and multiplied by all columns, block by block.
/// @param T 3 n_s x r, row 3 a + d: node a, direction d
/// @param reduced r x m
void expand(const rom::SkinRows& T, const Eigen::MatrixXd& reduced, const ExpansionBlock& block,
            const ExpansionSink& sink);

/// Rows as many as are in memory, else about 256 MB of T, a multiple of `multiple`; columns that
/// take about 64 MB with these rows, at least 1.
ExpansionBlock expansion_block(const rom::SkinRows& T, int64_t multiple);

}  // namespace clatter::recover
