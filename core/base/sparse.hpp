// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sparse matrices in memory and in files.
#include <Eigen/SparseCore>
#include <cstdint>
#include <string_view>

#include "core/base/h5_file.hpp"

namespace clatter {

/// Column-compressed sparse matrix with 32-bit indices. Symmetric matrices keep the lower triangle.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int32_t>;

/// Writes group `name` with data, indices, indptr and attributes format="csc", shape, symmetric
/// ("lower" or "no"). Row indices ascend within a column.
void write_sparse(H5File& file, std::string_view name, const SparseMatrix& matrix, bool lower);

/// Reads it; checks lengths, index ranges, sortedness and finite values (InputError).
SparseMatrix read_sparse(const H5File& file, std::string_view name);

/// y = A x for A given by its lower triangle; x is n x m.
Eigen::MatrixXd multiply_symmetric(const SparseMatrix& lower, const Eigen::MatrixXd& x);

/// |A| |x| with entrywise magnitudes.
Eigen::MatrixXd magnitude_product(const SparseMatrix& lower, const Eigen::MatrixXd& x);

}  // namespace clatter
