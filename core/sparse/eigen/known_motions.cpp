// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/known_motions.hpp"

#include <vector>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/dense/cholesky.hpp"

namespace clatter::sparse {

using Eigen::Index;
using Eigen::MatrixXd;

KnownMotions::KnownMotions(MatrixXd U, MatrixXd MU, const RowTeam& team)
    : U_(std::move(U)), MU_(std::move(MU)), team_(team) {}

void KnownMotions::remove(double* x, int count) const {
  if (U_.cols() == 0) return;
  constexpr Index kRows = 4096;  // rows per piece, so that sums do not depend on the threads
  const Index n = U_.rows(), pieces = (n + kRows - 1) / kRows;
  Eigen::Map<RowMatrix> X(x, n, count);
  std::vector<MatrixXd> part(static_cast<size_t>(pieces));
  parallel_pieces(pieces, [&](int64_t begin, int64_t end) {
    for (Index k = begin; k < end; ++k) {
      const Index rows = std::min(kRows, n - k * kRows);
      part[k] = MU_.middleRows(k * kRows, rows).transpose() * X.middleRows(k * kRows, rows);
    }
  });
  MatrixXd sum = MatrixXd::Zero(U_.cols(), count);
  for (const MatrixXd& one : part) sum += one;
  team_.sum(sum.data(), sum.size());
  parallel_pieces(pieces, [&](int64_t begin, int64_t end) {
    for (Index k = begin; k < end; ++k) {
      const Index rows = std::min(kRows, n - k * kRows);
      X.middleRows(k * kRows, rows) -= U_.middleRows(k * kRows, rows) * sum;
    }
  });
}

MatrixXd orthonormal_in_mass(const MatrixPencil& pencil, const MatrixXd& R) {
  MatrixXd U = R;
  for (int pass = 0; pass < 2 && U.cols() > 0; ++pass) {
    const dense::Cholesky gram(pencil.team().sum(MatrixXd(U.transpose() * pencil.mass_times(U))));
    if (!gram.ok())
      throw NumericsError("modes: the rigid-body motions are linearly dependent in M");
    U = gram.solve_lower(U.transpose()).transpose().eval();
  }
  return U;
}

}  // namespace clatter::sparse
