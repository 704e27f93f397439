// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/dense/solve.hpp"
#include "dynamics/film/banded_lu.hpp"

namespace clatter::film {
namespace {

TEST(BandedLu, AgreesWithDenseLuForOneAndManyRightHandSides) {
  const int n = 37, band = 5, k = 48;  // one wide strip and two narrow ones
  BandedLu lu(n, band);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  lu.set_zero();
  unsigned seed = 7;
  auto next = [&] {
    return static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / 16777216.0;
  };
  for (int j = 0; j < n; ++j) {
    for (int i = std::max(0, j - band); i <= std::min(n - 1, j + band); ++i)
      if (i != j) dense(i, j) = lu.at(i, j) = -next();
    dense(j, j) = lu.at(j, j) = -dense.col(j).sum() + 0.1;
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> b(n, k);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < k; ++c) b(i, c) = next();
  const Eigen::MatrixXd exact = clatter::dense::solve(dense, b);
  ASSERT_TRUE(lu.factor());
  Eigen::VectorXd one = b.col(0);
  lu.solve(one.data());
  lu.solve_rows(b.data(), k);
  EXPECT_LT((one - exact.col(0)).norm(), 1e-12 * exact.col(0).norm());  // condition about 1e2
  EXPECT_LT((b - exact).norm(), 1e-12 * exact.norm());
}

TEST(BandedLu, ReportsASingularMatrix) {
  BandedLu lu(3, 1);
  lu.set_zero();
  lu.at(0, 0) = 1.0;
  lu.at(2, 2) = 1.0;
  EXPECT_FALSE(lu.factor());
}

}  // namespace
}  // namespace clatter::film
