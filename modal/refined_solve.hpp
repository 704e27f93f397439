// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Solves A x = b to the accuracy that the entries of A allow, with an error estimate.
#include <Eigen/Core>

#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::modal {

struct RefinedSolution {
  Eigen::MatrixXd x;         // n x m
  Eigen::VectorXd backward;  // m: max_i |b - A x|_i / (|A| |x| + |b|)_i, the relative change of the
                             // entries for which x is exact (Oettli and Prager 1964); of rows whose
                             // denominator is rounding, |A| max |x| in its place (Arioli, Demmel
                             // and Duff 1989)
  Eigen::VectorXd forward;   // m: estimated error of x relative to its largest entry
  int steps = 0;             // of refinement
};

/// Iterative refinement with the residual in extended precision until it stagnates (Wilkinson 1963;
/// Demmel, Hida, Kahan, Li, Mukherjee and Riedy 2006), and an estimate of
///   max |A^{-1}| (|r| + eps (|A| |x| + |b|)) / max |x|,
/// the effect of the remaining residual and of rounding the entries of A and b to doubles, by
/// Hager's estimator of the 1-norm (Higham 1988; LAPACK's dporfs).
/// @param lower A, n x n, symmetric, lower triangle; @param b n x m.
RefinedSolution solve_refined(const sparse::SupernodalFactor& factor, const SparseMatrix& lower,
                              const Eigen::MatrixXd& b);

}  // namespace clatter::modal
