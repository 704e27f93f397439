// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenvalues of core/dense against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/dense/complex.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::dense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// 2 on the diagonal, -1 beside it: a row of n masses between n + 1 springs.
MatrixXd spring_row(int n) {
  MatrixXd K = 2.0 * MatrixXd::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) K(i, i + 1) = K(i + 1, i) = -1.0;
  return K;
}

/// Its eigenvalues, ascending: 4 sin^2(k pi / (2 (n + 1))).
VectorXd values_of_spring_row(int n) {
  return VectorXd::NullaryExpr(n, [n](Eigen::Index k) {
    return 4.0 *
           std::pow(std::sin(static_cast<double>(k + 1) * std::numbers::pi / (2.0 * (n + 1))), 2);
  });
}

TEST(DenseEigen, OfARowOfSpringsIsInClosedForm) {
  for (const int n : {1, 2, 7, 60}) {
    MatrixXd K = spring_row(n);
    const VectorXd exact = values_of_spring_row(n);
    K.triangularView<Eigen::StrictlyUpper>().setConstant(5.0);  // only the lower triangle counts
    const Eigenpairs found = symmetric_eigen(K);
    ASSERT_TRUE(found.ok);
    EXPECT_LT((found.values - exact).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((spring_row(n) * found.vectors - found.vectors * exact.asDiagonal()).norm(), 1e-12);
    EXPECT_LT((found.vectors.transpose() * found.vectors - MatrixXd::Identity(n, n)).norm(), 1e-12);
    const Eigenpairs values = symmetric_eigen(K, EigenParts::kValues);
    EXPECT_LT((values.values - exact).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_EQ(values.vectors.size(), 0);
    const Eigenpairs thin =
        tridiagonal_eigen(VectorXd::Constant(n, 2.0), VectorXd::Constant(n - 1, -1.0));
    EXPECT_LT((thin.values - exact).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((spring_row(n) * thin.vectors - thin.vectors * exact.asDiagonal()).norm(), 1e-12);
  }
}

TEST(DenseEigen, OfAPencilDiagonalisesBothMatrices) {
  const int n = 30;
  const MatrixXd A = spring_row(n), R = test::random_matrix(n, n);
  const MatrixXd B = R * R.transpose() + MatrixXd::Identity(n, n);
  const Eigenpairs found = symmetric_eigen(A, B);
  ASSERT_TRUE(found.ok);
  EXPECT_LT((found.vectors.transpose() * B * found.vectors - MatrixXd::Identity(n, n)).norm(),
            1e-10);
  EXPECT_LT((A * found.vectors - B * found.vectors * found.values.asDiagonal()).norm(), 1e-10);
  EXPECT_LT((symmetric_eigen(A, B, EigenParts::kValues).values - found.values).norm(), 1e-11);
}

TEST(DenseEigen, SaysWhatHasNoAnswer) {
  MatrixXd A = spring_row(40);
  A(30, 2) = kNotANumber;  // LAPACK may not return from this
  for (const Eigenpairs& found :
       {symmetric_eigen(A), symmetric_eigen(spring_row(40), A), symmetric_eigen(A, spring_row(40)),
        symmetric_eigen(spring_row(40), MatrixXd(-spring_row(40))),
        tridiagonal_eigen(VectorXd::Ones(40), VectorXd::Constant(39, kNotANumber))}) {
    EXPECT_FALSE(found.ok);
    ASSERT_EQ(found.values.size(), 40);
    EXPECT_TRUE(found.values.array().isNaN().all());
    EXPECT_TRUE(found.vectors.array().isNaN().all());
  }
  EXPECT_TRUE(symmetric_eigen(MatrixXd(0, 0)).ok);
  EXPECT_TRUE(eigenvalues(A)(0).real() != eigenvalues(A)(0).real());
}

TEST(DenseEigen, OfACompanionMatrixAreTheRootsOfItsPolynomial) {
  // (s - 3) (s^2 + 2 s + 5): 3, -1 + 2i, -1 - 2i; s^3 - s^2 - s - 15.
  MatrixXd companion = MatrixXd::Zero(3, 3);
  companion << 1.0, 1.0, 15.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  Eigen::VectorXcd found = eigenvalues(companion);
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.imag() < b.imag(); });
  const Eigen::Vector3cd exact({-1.0, -2.0}, {3.0, 0.0}, {-1.0, 2.0});
  EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(DenseEigen, OfAComplexMatrixHasPairs) {
  const Eigen::MatrixXcd A = test::random_matrix<Eigen::MatrixXcd>(12, 12);
  const ComplexEigenpairs found = complex_eigen(A);
  EXPECT_LT((A * found.vectors - found.vectors * found.values.asDiagonal()).norm(), 1e-12);
  EXPECT_LT((found.vectors.colwise().norm().array() - 1.0).abs().maxCoeff(), 1e-13);
  EXPECT_NEAR(std::abs(found.values.sum() - A.trace()), 0.0, 1e-12);
}

}  // namespace
}  // namespace clatter::dense
