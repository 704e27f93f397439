// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Orthonormalises arbitrary shapes of the interior.
#include <Eigen/Core>
#include <vector>

#include "core/sparse/eigen/matrix_pencil.hpp"

namespace clatter::condense {

/// X with X^T M X = I and X^T K X = diag(values), ascending.
struct ShapeBasis {
  Eigen::MatrixXd vectors;     // n x k
  Eigen::VectorXd values;      // k
  std::vector<int> dependent;  // columns of the input that were dropped
};

/// The part of `shapes` that `kept` does not span. A shape with a remainder below 1e-9 in the norm
/// of M after projection on `kept` and the shapes before it is dropped as dependent; Gram-Schmidt
/// in the mass inner product, twice, in blocks.
/// @param shapes n x m, of any length, zero too; kept n x p, eigenvectors of the pencil (K, M), n x
/// n, positive definite, with unit modal mass.
ShapeBasis shape_basis(const Eigen::MatrixXd& shapes, const Eigen::MatrixXd& kept,
                       const sparse::MatrixPencil& pencil);

}  // namespace clatter::condense
