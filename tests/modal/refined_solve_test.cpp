// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/refined_solve.hpp"

#include <gtest/gtest.h>

#include <random>

namespace clatter::modal {
namespace {

/// Bars that are pulled on, springs between them whose forces cancel, and a plate of DoFs that
/// hang on those springs alone: they do not move but by rounding.
SparseMatrix at_rest_beside_motion(int bars, int springs, int plate) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.2, 1.0);
  const int n = bars + springs + plate;
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n) * 8.0;
  for (int s = bars; s < bars + springs; ++s) {
    const double k = any(random);  // the bars move by 1, 2, 3, .. times one displacement
    const int i = s % (bars - 1);
    A(s, i) = k / (i + 1.0);
    A(s, i + 1) = -k / (i + 2.0);
    for (int p = bars + springs; p < n; ++p) A(p, s) = any(random) / springs;
  }
  return A.sparseView();
}

// As of lateral motions of a bar that is pulled: their rows have nothing to be compared with but
// rounding, and a ratio of roundings refused a right solution.
TEST(RefinedSolve, RowsBetweenDofsAtRestAreComparedWithTheMotionOfTheOthers) {
  constexpr int kBars = 6, kSprings = 30, kPlate = 12;
  const SparseMatrix A = at_rest_beside_motion(kBars, kSprings, kPlate);
  const sparse::SupernodalFactor factor(A);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
  for (int i = 0; i < kBars; ++i) b(i) = 0.1 * (i + 1.0);
  const RefinedSolution found = solve_refined(factor, A, b);
  for (int i = 0; i < kBars; ++i) EXPECT_NEAR(found.x(i, 0), b(i) / 8.0, 1e-16);
  EXPECT_LT(found.x.bottomRows(kSprings + kPlate).cwiseAbs().maxCoeff(), 1e-17);
  EXPECT_LT(found.backward(0), 1e-15);
  EXPECT_LT(found.forward(0), 1e-14);
}

TEST(RefinedSolve, AWrongFactorIsSeenInTheBackwardError) {
  const SparseMatrix A = at_rest_beside_motion(6, 30, 12);
  SparseMatrix other = A;
  other.coeffRef(3, 3) = 16.5;  // its solutions do not converge
  const RefinedSolution found =
      solve_refined(sparse::SupernodalFactor(other), A, Eigen::VectorXd::Ones(A.rows()));
  EXPECT_GT(found.backward(0), 1e-6);
}

}  // namespace
}  // namespace clatter::modal
