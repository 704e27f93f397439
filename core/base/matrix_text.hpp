// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Symmetric matrices in text files: Matrix Market, and the coordinate lists of Abaqus.
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter {

/// Writes a symmetric matrix as Matrix Market "coordinate real symmetric": the lower triangle
/// without its zeros, 17 digits, so that it reads back exactly. `comments` are header lines.
void write_matrix_market(const std::filesystem::path& path, const Eigen::MatrixXd& symmetric,
                         const std::vector<std::string>& comments);

/// Reads a symmetric matrix, lower triangle. Matrix Market (recognised by its first line):
/// coordinate or array, real or integer, symmetric or general with symmetric values. Otherwise
/// lines "i j value", 1-based, both triangles, as Abaqus writes with FORMAT=COORDINATE. InputError
/// "file:line: ..." for anything else, duplicate entries, or triangles that differ by more than
/// 1e-9 sqrt(a_ii a_jj).
SparseMatrix read_matrix_text(const std::filesystem::path& path);

}  // namespace clatter
