// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/complex_lu.hpp"

#include <cblas.h>
#include <lapack.h>

#include <limits>
#include <vector>

namespace clatter::sound {
namespace {

lapack_complex_double* raw(Eigen::MatrixXcd& matrix) {
  return reinterpret_cast<lapack_complex_double*>(matrix.data());
}

}  // namespace

ComplexSolution solve_dense(Eigen::MatrixXcd A_transposed, Eigen::MatrixXcd Y) {
  ComplexSolution out{std::move(Y), std::numeric_limits<double>::infinity()};
  const int n = static_cast<int>(A_transposed.rows()), m = static_cast<int>(out.X.cols());
  // The largest row sum of the matrix as stored is the largest column sum of A.
  const double size = A_transposed.cwiseAbs().rowwise().sum().maxCoeff();
  std::vector<int> pivots(static_cast<size_t>(n));
  int info = 0;
  LAPACK_zgetrf(&n, &n, raw(A_transposed), &n, pivots.data(), &info);
  if (info != 0) return out;
  double reciprocal = 0.0;
  Eigen::MatrixXcd work(2 * n, 1);
  std::vector<double> real_work(2 * static_cast<size_t>(n));
  LAPACK_zgecon("I", &n, raw(A_transposed), &n, &size, &reciprocal, raw(work), real_work.data(),
                &info);
  if (reciprocal > 0.0) out.condition = 1.0 / reciprocal;
  LAPACK_zgetrs("T", &n, &m, raw(A_transposed), &n, pivots.data(), raw(out.X), &n, &info);
  return out;
}

Eigen::MatrixXcd rows_product(const Eigen::MatrixXcd& B_transposed, const Eigen::MatrixXcd& V) {
  Eigen::MatrixXcd out(B_transposed.cols(), V.cols());
  const std::complex<double> one = 1.0, zero = 0.0;
  const int n = static_cast<int>(out.rows()), m = static_cast<int>(out.cols());
  const int p = static_cast<int>(V.rows());
  cblas_zgemm(CblasColMajor, CblasTrans, CblasNoTrans, n, m, p, &one, B_transposed.data(), p,
              V.data(), p, &zero, out.data(), n);
  return out;
}

}  // namespace clatter::sound
