#pragma once
// Symmetric matrices in text files: Matrix Market, and the coordinate lists of Abaqus.
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter {

/// Writes a symmetric matrix as Matrix Market "coordinate real symmetric": the lower triangle
/// without its zeros, 17 digits, so that it reads back to the last bit. `comments` are lines of the
/// head.
void write_matrix_market(const std::filesystem::path& path, const Eigen::MatrixXd& symmetric,
                         const std::vector<std::string>& comments);

/// Reads a symmetric matrix, lower triangle. Matrix Market (its first line says so): coordinate or
/// array, real or integer, symmetric or general with symmetric values. Otherwise lines "i j value",
/// from 1, both triangles, as Abaqus writes with FORMAT=COORDINATE. InputError "file:line: ..." for
/// what is not so, an entry that stands twice, or triangles that differ by more than 1e-9
/// sqrt(a_ii a_jj).
SparseMatrix read_matrix_text(const std::filesystem::path& path);

}  // namespace clatter
