// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/svd.hpp"

#include "core/dense/lapack_call.hpp"

namespace clatter::dense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// U, V^T and values as `job` says; false when the iteration did not converge.
bool decompose(char job, MatrixXd& A, MatrixXd& U, Eigen::VectorXd& values, MatrixXd& V_T) {
  const int m = lapack_size(A.rows()), n = lapack_size(A.cols());
  const int ldu = stride(U.rows()), ldv = stride(V_T.rows());
  std::vector<int> integers(8 * static_cast<size_t>(std::min(m, n)));
  int info = 0;
  with_workspace([&](double* work, const int* lwork) {
    LAPACK_dgesdd(&job, &m, &n, A.data(), &m, values.data(), U.data(), &ldu, V_T.data(), &ldv, work,
                  lwork, integers.data(), &info);
  });
  return info == 0;
}

}  // namespace

Svd svd(const MatrixXd& A) {
  const Index rows = A.rows(), n = A.cols(), both = std::min(rows, n);
  Svd out{no_answer(rows, both), no_answer(both, 1), no_answer(n, n)};
  if (!A.allFinite()) return out;
  if (both == 0) {
    out.V = MatrixXd::Identity(n, n);
    return out;
  }
  // With rows of zeros where there are fewer than columns, so that all of V is found.
  MatrixXd tall = MatrixXd::Zero(std::max(rows, n), n);
  tall.topRows(rows) = A;
  MatrixXd U(tall.rows(), n), V_T(n, n);
  Eigen::VectorXd values(n);
  if (!decompose('S', tall, U, values, V_T)) return out;
  return {U.topLeftCorner(rows, both), values.head(both), V_T.transpose()};
}

MatrixXd null_space(const MatrixXd& A, double tolerance) {
  const Svd found = svd(A);
  const double least = found.values.size() > 0 ? tolerance * found.values[0] : 0.0;
  const Index rank = (found.values.array() > least).count();
  return found.V.rightCols(A.cols() - rank);
}

Eigen::VectorXd singular_values(MatrixXd A) {
  Eigen::VectorXd values = no_answer(std::min(A.rows(), A.cols()), 1);
  if (!A.allFinite() || A.size() == 0) return values;
  MatrixXd none;
  if (!decompose('N', A, none, values, none)) return no_answer(values.size(), 1);
  return values;
}

}  // namespace clatter::dense
