// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Basis vectors that represent the truncated fixed-interface modes, and the remaining error.
#include "condense/basis/reduced_basis.hpp"

namespace clatter::condense {

/// A basis with the matrices projected on it.
struct Reduction : ReducedMatrices {
  ReducedBasis basis;
};

struct ResidualReport {
  bool estimated = false;       // the errors below are known
  Eigen::VectorXd hz;           // pseudo-frequencies of the added vectors, above the cut-off
  double error_before = 0.0;    // largest estimated relative frequency error without them
  double error_estimate = 0.0;  // and with them
  int modes = 0;                // elastic modes of the body below the limit
  Eigen::VectorXd modes_hz;     // and their frequencies
  Eigen::MatrixXd of_parts;     // modes x parts: fe::part_errors; no rows in a team
};

/// Corrects the modes of the entire body below `limit_hz` for the fixed-interface modes that the
/// basis lacks. A Ritz vector u with value lambda leaves the interior force
///   r = lambda (M u)_i - (K u)_i,
/// whose static response delta = K_ii^{-1} r with the boundary held is orthogonal to all kept modes
/// and lowers lambda by r^T delta to first order: that is both the correction (one step of inverse
/// iteration; Craig and Hale 1988 add such residual vectors by loads, here the modes' own inertia
/// is the load) and the estimate of the error r^T delta / (2 lambda) of the frequency. Vectors
/// whose estimate exceeds a hundredth of `target` are added, once each; passes are repeated until
/// every estimate is below `target`, at most four times.
/// @param motions n_b x m, boundary rows of the free rigid motions, which are no elastic modes.
/// @param target relative frequency error; 0 only estimates.
ResidualReport add_residual_modes(Reduction& reduction, const sparse::Factor& factor_ii,
                                  const PartitionedModel& part, const Eigen::MatrixXd& motions,
                                  double limit_hz, double target);

}  // namespace clatter::condense
