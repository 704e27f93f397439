// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/solve.hpp"

#include "core/dense/lapack_call.hpp"

namespace clatter::dense {

using Eigen::MatrixXd;

MatrixXd solve(MatrixXd A, MatrixXd B) {
  if (!A.allFinite()) return no_answer(B.rows(), B.cols());
  if (B.size() == 0) return B;
  const int n = lapack_size(A.rows()), m = lapack_size(B.cols());
  std::vector<int> pivots(static_cast<size_t>(n));
  int info = 0;
  LAPACK_dgesv(&n, &m, A.data(), &n, pivots.data(), B.data(), &n, &info);
  return info == 0 ? B : no_answer(B.rows(), B.cols());
}

MatrixXd solve_symmetric(MatrixXd A, MatrixXd B) {
  if (!A.allFinite()) return no_answer(B.rows(), B.cols());
  if (B.size() == 0) return B;
  const int n = lapack_size(A.rows()), m = lapack_size(B.cols());
  std::vector<int> pivots(static_cast<size_t>(n));
  int info = 0;
  with_workspace([&](double* work, const int* lwork) {
    LAPACK_dsysv("L", &n, &m, A.data(), &n, pivots.data(), B.data(), &n, work, lwork, &info);
  });
  return info == 0 ? B : no_answer(B.rows(), B.cols());
}

}  // namespace clatter::dense
