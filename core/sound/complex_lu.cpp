// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/complex_lu.hpp"

#include <cblas.h>
#include <lapack.h>

#include <limits>

namespace clatter::sound {
namespace {

lapack_complex_double* raw(Eigen::MatrixXcd& matrix) {
  return reinterpret_cast<lapack_complex_double*>(matrix.data());
}

const lapack_complex_double* raw(const Eigen::MatrixXcd& matrix) {
  return reinterpret_cast<const lapack_complex_double*>(matrix.data());
}

}  // namespace

ComplexLu::ComplexLu(Eigen::MatrixXcd A_transposed)
    : factors_(std::move(A_transposed)),
      pivots_(static_cast<size_t>(factors_.rows())),
      condition_(std::numeric_limits<double>::infinity()) {
  const int n = static_cast<int>(factors_.rows());
  // The largest row sum of the matrix as stored is the largest column sum of A.
  const double size = factors_.cwiseAbs().rowwise().sum().maxCoeff();
  int info = 0;
  LAPACK_zgetrf(&n, &n, raw(factors_), &n, pivots_.data(), &info);
  if (info != 0) return;
  double reciprocal = 0.0;
  Eigen::MatrixXcd work(2 * n, 1);
  std::vector<double> real_work(2 * static_cast<size_t>(n));
  LAPACK_zgecon("I", &n, raw(factors_), &n, &size, &reciprocal, raw(work), real_work.data(), &info);
  if (reciprocal > 0.0) condition_ = 1.0 / reciprocal;
}

Eigen::MatrixXcd ComplexLu::substituted(char which, Eigen::MatrixXcd Y) const {
  const int n = static_cast<int>(factors_.rows()), m = static_cast<int>(Y.cols());
  int info = 0;
  LAPACK_zgetrs(&which, &n, &m, raw(factors_), &n, pivots_.data(), raw(Y), &n, &info);
  return Y;
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
