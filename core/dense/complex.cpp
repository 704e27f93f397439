// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/complex.hpp"

#include <complex>

#include "core/dense/lapack_call.hpp"

namespace clatter::dense {
namespace {

using Eigen::MatrixXcd;

lapack_complex_double* raw(std::complex<double>* data) {
  return reinterpret_cast<lapack_complex_double*>(data);
}

MatrixXcd no_complex_answer(Eigen::Index rows, Eigen::Index cols) {
  return no_answer(rows, cols).cast<std::complex<double>>();
}

/// Calls `routine(work, lwork)` for the size of the workspace, then for the result.
template <class Routine>
void with_complex_workspace(Routine&& routine) {
  std::complex<double> best = 0.0;
  const int query = -1;
  routine(raw(&best), &query);
  const int room = std::max(1, static_cast<int>(best.real()));
  std::vector<std::complex<double>> work(static_cast<size_t>(room));
  routine(raw(work.data()), &room);
}

}  // namespace

Eigen::VectorXcd eigenvalues(Eigen::MatrixXd A) {
  const int n = lapack_size(A.rows()), one = 1;
  if (!A.allFinite()) return no_complex_answer(n, 1);
  if (n == 0) return {};
  Eigen::VectorXd real(n), imaginary(n);
  int info = 0;
  with_workspace([&](double* work, const int* lwork) {
    LAPACK_dgeev("N", "N", &n, A.data(), &n, real.data(), imaginary.data(), nullptr, &one, nullptr,
                 &one, work, lwork, &info);
  });
  if (info != 0) return no_complex_answer(n, 1);
  Eigen::VectorXcd out(n);
  for (int k = 0; k < n; ++k) out[k] = {real[k], imaginary[k]};
  return out;
}

ComplexEigenpairs complex_eigen(MatrixXcd A) {
  const int n = lapack_size(A.rows()), one = 1;
  ComplexEigenpairs out{no_complex_answer(n, 1), no_complex_answer(n, n)};
  if (!A.allFinite() || n == 0) return out;
  std::vector<double> real_work(2 * static_cast<size_t>(n));
  int info = 0;
  with_complex_workspace([&](lapack_complex_double* work, const int* lwork) {
    LAPACK_zgeev("N", "V", &n, raw(A.data()), &n, raw(out.values.data()), nullptr, &one,
                 raw(out.vectors.data()), &n, work, lwork, real_work.data(), &info);
  });
  if (info != 0) return {no_complex_answer(n, 1), no_complex_answer(n, n)};
  return out;
}

MatrixXcd solve_complex(MatrixXcd A, MatrixXcd B) {
  if (!A.allFinite()) return no_complex_answer(B.rows(), B.cols());
  if (B.size() == 0) return B;
  const int n = lapack_size(A.rows()), m = lapack_size(B.cols());
  std::vector<int> pivots(static_cast<size_t>(n));
  int info = 0;
  LAPACK_zgesv(&n, &m, raw(A.data()), &n, pivots.data(), raw(B.data()), &n, &info);
  return info == 0 ? B : no_complex_answer(B.rows(), B.cols());
}

MatrixXcd orthonormal(MatrixXcd A) {
  const Eigen::Index both = std::min(A.rows(), A.cols());
  if (!A.allFinite()) return no_complex_answer(A.rows(), both);
  if (both > 0) {
    const int m = lapack_size(A.rows()), k = lapack_size(both);
    std::vector<std::complex<double>> scales(static_cast<size_t>(both));
    int info = 0;
    with_complex_workspace([&](lapack_complex_double* work, const int* lwork) {
      LAPACK_zgeqrf(&m, &k, raw(A.data()), &m, raw(scales.data()), work, lwork, &info);
    });
    with_complex_workspace([&](lapack_complex_double* work, const int* lwork) {
      LAPACK_zungqr(&m, &k, &k, raw(A.data()), &m, raw(scales.data()), work, lwork, &info);
    });
  }
  A.conservativeResize(Eigen::NoChange, both);
  return A;
}

}  // namespace clatter::dense
