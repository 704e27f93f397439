// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/dense_eigen.hpp"

#include <lapack.h>

#include <vector>

namespace clatter::sparse {
namespace {

/// Calls `solver(work, lwork, iwork, liwork)` for the sizes, then for the result.
template <class Solver>
void with_workspace(Solver&& solver) {
  double best = 0.0;
  int best_integers = 0;
  const int query = -1;
  solver(&best, &query, &best_integers, &query);
  const int room = static_cast<int>(best);
  std::vector<double> work(static_cast<size_t>(room));
  std::vector<int> integers(static_cast<size_t>(best_integers));
  solver(work.data(), &room, integers.data(), &best_integers);
}

/// Common part of both drivers; LAPACK may not terminate on non-finite values.
template <class Driver>
DenseEigen solve(const Eigen::MatrixXd& A, EigenParts parts, Driver&& driver) {
  DenseEigen out;
  if (!A.allFinite()) return out;
  out.vectors = A;
  out.values.resize(A.rows());
  const char job = parts == EigenParts::kVectors ? 'V' : 'N';
  int info = 0;
  if (A.rows() > 0) driver(job, static_cast<int>(A.rows()), out, info);
  if (parts == EigenParts::kValues) out.vectors.resize(0, 0);
  out.ok = info == 0;
  return out;
}

}  // namespace

DenseEigen symmetric_eigen(const Eigen::MatrixXd& A, EigenParts parts) {
  return solve(A, parts, [](char job, int n, DenseEigen& out, int& info) {
    with_workspace([&](double* work, const int* lwork, int* iwork, const int* liwork) {
      LAPACK_dsyevd(&job, "L", &n, out.vectors.data(), &n, out.values.data(), work, lwork, iwork,
                    liwork, &info);
    });
  });
}

DenseEigen symmetric_eigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, EigenParts parts) {
  if (!B.allFinite()) return {};
  Eigen::MatrixXd factor = B;
  return solve(A, parts, [&](char job, int n, DenseEigen& out, int& info) {
    const int type = 1;
    with_workspace([&](double* work, const int* lwork, int* iwork, const int* liwork) {
      LAPACK_dsygvd(&type, &job, "L", &n, out.vectors.data(), &n, factor.data(), &n,
                    out.values.data(), work, lwork, iwork, liwork, &info);
    });
  });
}

}  // namespace clatter::sparse
