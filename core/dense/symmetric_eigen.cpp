// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/symmetric_eigen.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/dense/lapack_call.hpp"

namespace clatter::dense {
namespace {

/// Common part of all drivers; LAPACK may not terminate on values that are not finite.
template <class Driver>
Eigenpairs solve(Eigen::MatrixXd A, bool finite, EigenParts parts, Driver&& driver) {
  Eigenpairs out;
  const Eigen::Index n = A.rows();
  out.vectors = std::move(A);
  out.values.resize(n);
  const char job = parts == EigenParts::kVectors ? 'V' : 'N';
  int info = finite ? 0 : -1;
  if (finite && n > 0) driver(job, lapack_size(n), out, info);
  out.ok = info == 0;
  if (!out.ok) {
    out.values = no_answer(n, 1);
    out.vectors = no_answer(n, n);
  }
  if (parts == EigenParts::kValues) out.vectors.resize(0, 0);
  return out;
}

/// Up to this size the QR iteration is as fast as LAPACK, whose last bits depend on BLAS's threads.
constexpr Eigen::Index kSmall = 64;

int requested(EigenParts parts) {
  return parts == EigenParts::kVectors ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly;
}

template <class Solver>
Eigenpairs pairs_of(const Solver& eigen, EigenParts parts) {
  Eigenpairs out;
  out.values = eigen.eigenvalues();
  if (parts == EigenParts::kVectors) out.vectors = eigen.eigenvectors();
  out.ok = eigen.info() == Eigen::Success;
  return out;
}

}  // namespace

Eigenpairs symmetric_eigen(Eigen::MatrixXd A, EigenParts parts) {
  const bool finite = A.allFinite();
  if (finite && A.rows() > 0 && A.rows() <= kSmall)
    return pairs_of(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, requested(parts)), parts);
  return solve(std::move(A), finite, parts, [](char job, int n, Eigenpairs& out, int& info) {
    with_workspaces([&](double* work, const int* lwork, int* iwork, const int* liwork) {
      LAPACK_dsyevd(&job, "L", &n, out.vectors.data(), &n, out.values.data(), work, lwork, iwork,
                    liwork, &info);
    });
  });
}

Eigenpairs symmetric_eigen(Eigen::MatrixXd A, Eigen::MatrixXd B, EigenParts parts) {
  const bool finite = A.allFinite() && B.allFinite();
  if (finite && A.rows() > 0 && A.rows() <= kSmall && B.llt().info() == Eigen::Success)
    return pairs_of(Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                        A, B, requested(parts) | Eigen::Ax_lBx),
                    parts);
  return solve(std::move(A), finite, parts, [&](char job, int n, Eigenpairs& out, int& info) {
    const int type = 1;
    with_workspaces([&](double* work, const int* lwork, int* iwork, const int* liwork) {
      LAPACK_dsygvd(&type, &job, "L", &n, out.vectors.data(), &n, B.data(), &n, out.values.data(),
                    work, lwork, iwork, liwork, &info);
    });
  });
}

Eigenpairs tridiagonal_eigen(Eigen::VectorXd diagonal, Eigen::VectorXd below) {
  const bool finite = diagonal.allFinite() && below.allFinite();
  const Eigen::Index n = diagonal.size();
  below.conservativeResize(std::max<Eigen::Index>(n, 1));  // what LAPACK leaves free
  return solve(
      Eigen::MatrixXd(n, n), finite, EigenParts::kVectors,
      [&](char job, int size, Eigenpairs& out, int& info) {
        with_workspaces([&](double* work, const int* lwork, int* iwork, const int* liwork) {
          LAPACK_dstevd(&job, &size, diagonal.data(), below.data(), out.vectors.data(), &size, work,
                        lwork, iwork, liwork, &info);
        });
        out.values = diagonal;
      });
}

}  // namespace clatter::dense
