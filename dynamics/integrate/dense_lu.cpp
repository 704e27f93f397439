// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/dense_lu.hpp"

#include <lapack.h>

#include <algorithm>

namespace clatter::dynamics {

Eigen::Map<Eigen::MatrixXd> DenseLu::matrix(Eigen::Index n) {
  n_ = static_cast<int>(n);
  const auto entries = static_cast<size_t>(n * n);
  memory_.resize(std::max(memory_.size(), entries));
  pivots_.resize(std::max(pivots_.size(), static_cast<size_t>(n)));
  return {memory_.data(), n, n};
}

bool DenseLu::factor() {
  if (n_ == 0) return true;
  const Eigen::Map<const Eigen::MatrixXd> matrix(memory_.data(), n_, n_);
  if (!matrix.allFinite()) return false;
  int info = 0;
  LAPACK_dgetrf(&n_, &n_, memory_.data(), &n_, pivots_.data(), &info);
  return info == 0 && matrix.allFinite();
}

void DenseLu::solve(double* x) const {
  if (n_ == 0) return;
  const int one = 1;
  int info = 0;
  LAPACK_dgetrs("N", &n_, &one, memory_.data(), &n_, pivots_.data(), x, &n_, &info);
}

}  // namespace clatter::dynamics
