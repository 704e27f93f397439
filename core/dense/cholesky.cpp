// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/cholesky.hpp"

#include "core/dense/lapack_call.hpp"

namespace clatter::dense {

using Eigen::MatrixXd;

Cholesky::Cholesky(MatrixXd A) : factor_(std::move(A)) {
  const int n = lapack_size(factor_.rows());
  ok_ = factor_.allFinite();
  if (!ok_ || n == 0) return;
  Eigen::VectorXd work(n);
  size_ = LAPACK_dlansy("1", "L", &n, factor_.data(), &n, work.data());
  int info = 0;
  LAPACK_dpotrf("L", &n, factor_.data(), &n, &info);
  ok_ = info == 0;
}

MatrixXd Cholesky::lower() const {
  if (!ok_) return no_answer(factor_.rows(), factor_.cols());
  MatrixXd L = MatrixXd::Zero(factor_.rows(), factor_.cols());
  for (Eigen::Index j = 0; j < L.cols(); ++j)
    std::copy(&factor_(j, j), factor_.data() + (j + 1) * factor_.rows(), &L(j, j));
  return L;
}

MatrixXd Cholesky::solve(MatrixXd B) const {
  if (!ok_) return no_answer(B.rows(), B.cols());
  const int n = stride(factor_.rows()), m = lapack_size(B.cols());
  int info = 0;
  if (B.size() > 0) LAPACK_dpotrs("L", &n, &m, factor_.data(), &n, B.data(), &n, &info);
  return B;
}

MatrixXd Cholesky::solve_lower(MatrixXd B) const { return triangle_solved('N', std::move(B)); }
MatrixXd Cholesky::solve_upper(MatrixXd B) const { return triangle_solved('T', std::move(B)); }

MatrixXd Cholesky::triangle_solved(char transposed, MatrixXd B) const {
  if (!ok_) return no_answer(B.rows(), B.cols());
  const int n = stride(factor_.rows()), m = lapack_size(B.cols());
  int info = 0;
  if (B.size() > 0)
    LAPACK_dtrtrs("L", &transposed, "N", &n, &m, factor_.data(), &n, B.data(), &n, &info);
  return B;
}

double Cholesky::reciprocal_condition() const {
  if (!ok_) return 0.0;
  const int n = lapack_size(factor_.rows());
  if (n == 0) return 1.0;
  double reciprocal = 0.0;
  std::vector<double> work(3 * static_cast<size_t>(n));
  std::vector<int> integers(static_cast<size_t>(n));
  int info = 0;
  LAPACK_dpocon("L", &n, factor_.data(), &n, &size_, &reciprocal, work.data(), integers.data(),
                &info);
  return reciprocal;
}

}  // namespace clatter::dense
