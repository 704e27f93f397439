// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Products of tall dense matrices through BLAS.
#include <Eigen/Core>

#include "core/base/sparse.hpp"

namespace clatter::sparse {

using DenseView = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using DenseOut = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// The number of rows or columns as BLAS takes it; a block has fewer than 2^31 of either.
inline int blas_size(Eigen::Index value) { return static_cast<int>(value); }

/// A^T B; A is n x p, B is n x q.
Eigen::MatrixXd transposed_product(const DenseView& A, const DenseView& B);

/// The same for row-major B.
Eigen::MatrixXd transposed_rows_product(const DenseView& A, const RowMatrix& B);

/// C += factor A B; A is n x p, B is p x q, C is n x q and overlaps neither.
void add_product(double factor, const DenseView& A, const DenseView& B, DenseOut C);

}  // namespace clatter::sparse
