// SPDX-License-Identifier: GPL-3.0-or-later
// Factors, solutions, bases and singular values of core/dense against hand-computed values, and by
// what holds for any matrix.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/dense/cholesky.hpp"
#include "core/dense/complex.hpp"
#include "core/dense/exponential.hpp"
#include "core/dense/least_squares.hpp"
#include "core/dense/qr.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/svd.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::dense {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-12;  // of numbers near one in matrices of some tens

MatrixXd matrix_of(std::initializer_list<std::initializer_list<double>> rows) {
  return MatrixXd(Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>(rows));
}

double largest_difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

MatrixXd definite(int n) {
  const MatrixXd A = test::random_matrix(n, n);
  return A * A.transpose() + MatrixXd::Identity(n, n);
}

TEST(DenseCholesky, OfTwoByTwoIsThatByHand) {
  const Cholesky by_hand(matrix_of({{4.0, 99.0}, {2.0, 10.0}}));
  ASSERT_TRUE(by_hand.ok()) << "the upper triangle is not read";
  EXPECT_LT(largest_difference(by_hand.lower(), matrix_of({{2.0, 0.0}, {1.0, 3.0}})), 1e-15);
  // [4 2; 2 10] x = [8; 22] has x = [1; 2].
  EXPECT_LT(
      largest_difference(by_hand.solve(matrix_of({{8.0}, {22.0}})), matrix_of({{1.0}, {2.0}})),
      1e-15);
  // Its inverse has the columns [10 -2] / 36 and [-2 4] / 36: |A|_1 |A^-1|_1 = 12 * 12 / 36.
  EXPECT_NEAR(by_hand.reciprocal_condition(), 36.0 / 144.0, 1e-15);
}

TEST(DenseCholesky, TrianglesGiveTheMatrixAndItsSolution) {
  const MatrixXd A = definite(40), B = test::random_matrix(40, 7);
  const Cholesky factor(A);
  ASSERT_TRUE(factor.ok());
  EXPECT_LT(largest_difference(factor.lower() * factor.lower().transpose(), A), kRounding);
  EXPECT_LT(largest_difference(A * factor.solve(B), B), 1e-10);
  EXPECT_LT(largest_difference(factor.lower() * factor.solve_lower(B), B), kRounding);
  EXPECT_LT(largest_difference(factor.lower().transpose() * factor.solve_upper(B), B), kRounding);
}

TEST(DenseCholesky, SaysThatAMatrixIsNotDefinite) {
  EXPECT_FALSE(Cholesky(matrix_of({{1.0, 2.0}, {2.0, 1.0}})).ok());
  EXPECT_FALSE(Cholesky(matrix_of({{1.0, 0.0}, {kNaN, 1.0}})).ok());
  const Cholesky none(matrix_of({{-1.0}}));
  EXPECT_EQ(none.reciprocal_condition(), 0.0);
  EXPECT_TRUE(none.solve(MatrixXd::Ones(1, 2)).array().isNaN().all());
  EXPECT_TRUE(none.lower().array().isNaN().all());
  EXPECT_TRUE(Cholesky(MatrixXd(0, 0)).ok());
}

TEST(DenseSolve, LeavesARestOfRounding) {
  const MatrixXd A = test::random_matrix(30, 30), B = test::random_matrix(30, 4);
  EXPECT_LT(largest_difference(A * solve(A, B), B), 1e-10);
  EXPECT_LT(
      largest_difference(solve(matrix_of({{0.0, 2.0}, {4.0, 0.0}}), matrix_of({{6.0}, {8.0}})),
                         matrix_of({{2.0}, {3.0}})),
      1e-15);
  EXPECT_EQ(solve(A, MatrixXd(30, 0)).cols(), 0);
}

TEST(DenseSolve, OfAnIndefiniteMatrixReadsItsLowerTriangle) {
  MatrixXd A = test::random_matrix(25, 25);
  A = (A + A.transpose()).eval();
  const MatrixXd B = test::random_matrix(25, 3);
  MatrixXd lower = A;
  lower.triangularView<Eigen::StrictlyUpper>().setConstant(7.0);
  EXPECT_LT(largest_difference(A * solve_symmetric(lower, B), B), 1e-9);
  // Without pivoting the zero would divide.
  EXPECT_LT(largest_difference(
                solve_symmetric(matrix_of({{0.0, 1.0}, {1.0, 0.0}}), matrix_of({{3.0}, {5.0}})),
                matrix_of({{5.0}, {3.0}})),
            1e-15);
}

TEST(DenseSolve, OfASingularMatrixIsNotANumber) {
  const MatrixXd singular = matrix_of({{1.0, 1.0}, {1.0, 1.0}}), one = MatrixXd::Ones(2, 1);
  EXPECT_TRUE(solve(singular, one).array().isNaN().all());
  EXPECT_TRUE(solve_symmetric(singular, one).array().isNaN().all());
  EXPECT_TRUE(solve(matrix_of({{kNaN}}), MatrixXd::Ones(1, 1)).array().isNaN().all());
  EXPECT_TRUE(solve_symmetric(matrix_of({{kNaN}}), MatrixXd::Ones(1, 1)).array().isNaN().all());
}

TEST(DenseSolve, OfComplexNumbersLeavesARestOfRounding) {
  const MatrixXcd A = test::random_matrix<MatrixXcd>(20, 20),
                  B = test::random_matrix<MatrixXcd>(20, 2);
  EXPECT_LT((A * solve_complex(A, B) - B).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_TRUE(solve_complex(MatrixXcd(MatrixXcd::Zero(2, 2)), MatrixXcd(MatrixXcd::Ones(2, 1)))
                  .real()
                  .array()
                  .isNaN()
                  .all());
}

TEST(DenseLeastSquares, OfALineThroughThreePointsIsThatByHand) {
  // y = 1, 2, 2 at x = 0, 1, 2: 7/6 + x / 2.
  const LeastSquares fit = least_squares(matrix_of({{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}}),
                                         matrix_of({{1.0}, {2.0}, {2.0}}));
  EXPECT_EQ(fit.rank, 2);
  EXPECT_LT(largest_difference(fit.X, matrix_of({{7.0 / 6.0}, {0.5}})), 1e-14);
}

TEST(DenseLeastSquares, TakesTheLeastOfAllSolutions) {
  const LeastSquares wide = least_squares(matrix_of({{1.0, 1.0}}), matrix_of({{2.0}}));
  EXPECT_EQ(wide.rank, 1);
  EXPECT_LT(largest_difference(wide.X, matrix_of({{1.0}, {1.0}})), 1e-15);
  // What lies below the tolerance is left out.
  const MatrixXd flat = matrix_of({{1.0, 0.0}, {0.0, 1e-9}});
  EXPECT_EQ(least_squares(flat, MatrixXd::Ones(2, 1)).rank, 2);
  const LeastSquares without = least_squares(flat, MatrixXd::Ones(2, 1), 1e-6);
  EXPECT_EQ(without.rank, 1);
  EXPECT_LT(largest_difference(without.X, matrix_of({{1.0}, {0.0}})), 1e-15);
}

TEST(DenseLeastSquares, ThePseudoInverseFulfilsTheFourConditionsOfPenrose) {
  const MatrixXd A = test::random_matrix(12, 3) * test::random_matrix(3, 8);  // rank 3
  const MatrixXd P = pseudo_inverse(A);
  ASSERT_EQ(P.rows(), 8);
  ASSERT_EQ(P.cols(), 12);
  EXPECT_LT(largest_difference(A * P * A, A), kRounding);
  EXPECT_LT(largest_difference(P * A * P, P), kRounding);
  EXPECT_LT(largest_difference(A * P, (A * P).transpose()), kRounding);
  EXPECT_LT(largest_difference(P * A, (P * A).transpose()), kRounding);
}

TEST(DenseLeastSquares, OfNothingIsZeroAndOfNaNIsNaN) {
  EXPECT_EQ(least_squares(MatrixXd(0, 3), MatrixXd(0, 2)).X, MatrixXd::Zero(3, 2));
  EXPECT_EQ(pseudo_inverse(MatrixXd::Zero(2, 3)), MatrixXd::Zero(3, 2));
  EXPECT_TRUE(pseudo_inverse(matrix_of({{kNaN, 1.0}})).array().isNaN().all());
}

TEST(DenseQr, GivesAnOrthonormalBasisOfTallAndWideMatrices) {
  for (const auto& [rows, cols] : {std::pair{30, 6}, {6, 6}, {4, 9}, {5, 0}}) {
    const MatrixXd A = test::random_matrix(rows, cols);
    const Qr found = qr(A);
    const int k = std::min(rows, cols);
    ASSERT_EQ(found.Q.cols(), k);
    EXPECT_LT((found.Q * found.R - A).norm(), kRounding);
    EXPECT_LT((found.Q.transpose() * found.Q - MatrixXd::Identity(k, k)).norm(), kRounding);
    EXPECT_EQ(MatrixXd(found.R.triangularView<Eigen::StrictlyLower>()).norm(), 0.0);
  }
  const MatrixXcd A = test::random_matrix<MatrixXcd>(11, 3), Q = orthonormal(A);
  EXPECT_LT((Q.adjoint() * Q - MatrixXcd::Identity(3, 3)).norm(), kRounding);
  EXPECT_LT((A - Q * (Q.adjoint() * A)).norm(), kRounding);
}

TEST(DenseSvd, OfTallAndWideMatricesIsComplete) {
  for (const auto& [rows, cols] : {std::pair{20, 5}, {5, 5}, {3, 7}}) {
    const MatrixXd A = test::random_matrix(rows, cols);
    const Svd found = svd(A);
    const int k = std::min(rows, cols);
    ASSERT_EQ(found.values.size(), k);
    EXPECT_LT((found.U * found.values.asDiagonal() * found.V.leftCols(k).transpose() - A).norm(),
              kRounding);
    EXPECT_LT((found.U.transpose() * found.U - MatrixXd::Identity(k, k)).norm(), kRounding);
    EXPECT_LT((found.V.transpose() * found.V - MatrixXd::Identity(cols, cols)).norm(), kRounding);
    EXPECT_LT((A * found.V.rightCols(cols - k)).norm(), kRounding);
    EXPECT_LT((singular_values(A) - found.values).norm(), kRounding);
    for (int i = 1; i < k; ++i) EXPECT_LE(found.values[i], found.values[i - 1]);
  }
}

TEST(DenseSvd, OfARotatedStretchIsTheStretch) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const MatrixXd A = matrix_of({{c, -s}, {s, c}}) * matrix_of({{3.0, 0.0}, {0.0, 0.5}});
  EXPECT_LT(largest_difference(singular_values(A), matrix_of({{3.0}, {0.5}})), 1e-15);
  EXPECT_TRUE(singular_values(matrix_of({{kNaN, 1.0}})).array().isNaN().all());
  EXPECT_TRUE(svd(matrix_of({{kNaN, 1.0}})).V.array().isNaN().all());
  EXPECT_EQ(svd(MatrixXd(0, 3)).V, MatrixXd::Identity(3, 3));
}

TEST(DenseSvd, TheNullSpaceIsWhatAMatrixMapsToZero) {
  const MatrixXd N = null_space(matrix_of({{1.0, 1.0, 0.0}}));
  ASSERT_EQ(N.cols(), 2);
  EXPECT_LT((matrix_of({{1.0, 1.0, 0.0}}) * N).norm(), 1e-15);
  EXPECT_LT((N.transpose() * N - MatrixXd::Identity(2, 2)).norm(), 1e-15);
  EXPECT_EQ(null_space(MatrixXd::Identity(3, 3)).cols(), 0);
  EXPECT_EQ(null_space(MatrixXd::Zero(2, 3)).cols(), 3);
}

TEST(DenseExponential, OfARotationIsItsCosineAndSine) {
  for (const double angle : {1e-9, 0.5, 3.0, 40.0}) {
    const MatrixXd found = exponential(matrix_of({{0.0, -angle}, {angle, 0.0}}));
    const double c = std::cos(angle), s = std::sin(angle);
    EXPECT_LT(largest_difference(found, matrix_of({{c, -s}, {s, c}})), 1e-13 * (1.0 + angle));
  }
  // Without eigenvectors: e^t (1 + t N) of a Jordan block.
  const MatrixXd jordan = exponential(matrix_of({{2.0, 1.0}, {0.0, 2.0}}));
  const double e2 = std::exp(2.0);
  EXPECT_LT(largest_difference(jordan, matrix_of({{e2, e2}, {0.0, e2}})), 1e-13);
}

TEST(DenseExponential, OfASumOfWhatCommutesIsTheProduct) {
  const MatrixXd A = test::random_matrix(9, 9);
  const MatrixXd whole = exponential(3.0 * A);
  EXPECT_LT((exponential(A) * exponential(2.0 * A) - whole).norm(), 1e-11 * whole.norm());
  EXPECT_LT((exponential(A) * exponential(-A) - MatrixXd::Identity(9, 9)).norm(), 1e-10);
  EXPECT_TRUE(exponential(matrix_of({{kNaN}})).array().isNaN().all());
  EXPECT_EQ(exponential(MatrixXd(0, 0)).size(), 0);
}

}  // namespace
}  // namespace clatter::dense
