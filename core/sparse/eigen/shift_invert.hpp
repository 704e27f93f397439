// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Input and result of an eigen-solver for K x = lambda M x.
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>

#include "core/sparse/row_team.hpp"

namespace clatter::sparse {

/// The spectral transformation nu = 1 / (lambda - sigma) (Ericsson and Ruhe, 1980): the wanted
/// lowest lambda become the largest nu of (K - sigma M)^{-1} M.
struct ShiftInvert {
  /// y = A x for `count` row-major vectors, size x count; y must not alias x.
  using Apply = std::function<void(const double* x, double* y, int count)>;
  int64_t size = 0;                      // rows of this process
  const RowTeam* team = &one_process();  // shares the rows
  double sigma = 0.0;  // [rad2/s2], below every eigenvalue, so that K - sigma M is definite
  Apply solve;         // (K - sigma M)^{-1} x
  Apply mass;          // M x
};

enum class EigenStatus { kConverged, kNotConverged, kOperatorFailed, kBadInput, kStopped, kFailed };

/// Eigenpairs, or why there are none; values and vectors are empty unless `status` is kConverged.
struct [[nodiscard]] EigenResult {
  EigenStatus status = EigenStatus::kFailed;
  std::string message;
  Eigen::VectorXd values;   // lambda [rad2/s2], ascending
  Eigen::MatrixXd vectors;  // n x m, M-orthonormal
  Eigen::VectorXd errors;   // estimated relative errors of frequencies; empty: rounding level
  int64_t solves = 0;       // right-hand sides solved with the factor

  bool ok() const { return status == EigenStatus::kConverged; }
};

}  // namespace clatter::sparse
