// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/least_squares.hpp"

#include "core/dense/lapack_call.hpp"

namespace clatter::dense {

using Eigen::Index;
using Eigen::MatrixXd;

LeastSquares least_squares(MatrixXd A, const MatrixXd& B, double tolerance) {
  const Index rows = A.rows(), cols = A.cols(), longer = std::max(rows, cols);
  if (!A.allFinite()) return {no_answer(cols, B.cols()), 0};
  if (rows == 0 || cols == 0) return {MatrixXd::Zero(cols, B.cols()), 0};
  if (tolerance < 0.0)
    tolerance = std::numeric_limits<double>::epsilon() * static_cast<double>(longer);
  MatrixXd X = MatrixXd::Zero(longer, B.cols());
  X.topRows(rows) = B;
  const int m = lapack_size(rows), n = lapack_size(cols), k = lapack_size(B.cols()),
            ldx = lapack_size(longer);
  std::vector<int> pivots(static_cast<size_t>(n), 0);
  int rank = 0, info = 0;
  with_workspace([&](double* work, const int* lwork) {
    LAPACK_dgelsy(&m, &n, &k, A.data(), &m, X.data(), &ldx, pivots.data(), &tolerance, &rank, work,
                  lwork, &info);
  });
  return {X.topRows(cols), rank};
}

MatrixXd pseudo_inverse(MatrixXd A, double tolerance) {
  const MatrixXd unit = MatrixXd::Identity(A.rows(), A.rows());
  return least_squares(std::move(A), unit, tolerance).X;
}

}  // namespace clatter::dense
