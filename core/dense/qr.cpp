// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/qr.hpp"

#include "core/dense/lapack_call.hpp"

namespace clatter::dense {

using Eigen::Index;
using Eigen::MatrixXd;

Qr qr(MatrixXd A) {
  const Index rows = A.rows(), cols = A.cols(), both = std::min(rows, cols);
  if (!A.allFinite()) return {no_answer(rows, both), no_answer(both, cols)};
  Qr out{{}, MatrixXd::Zero(both, cols)};
  if (both > 0) {
    const int m = lapack_size(rows), n = lapack_size(cols), k = lapack_size(both);
    std::vector<double> scales(static_cast<size_t>(both));
    int info = 0;
    with_workspace([&](double* work, const int* lwork) {
      LAPACK_dgeqrf(&m, &n, A.data(), &m, scales.data(), work, lwork, &info);
    });
    for (Index j = 0; j < cols; ++j) {
      const Index count = std::min(j + 1, both);
      out.R.col(j).head(count) = A.col(j).head(count);
    }
    with_workspace([&](double* work, const int* lwork) {
      LAPACK_dorgqr(&m, &k, &k, A.data(), &m, scales.data(), work, lwork, &info);
    });
  }
  A.conservativeResize(Eigen::NoChange, both);
  out.Q = std::move(A);
  return out;
}

}  // namespace clatter::dense
