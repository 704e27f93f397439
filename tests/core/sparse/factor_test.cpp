// SPDX-License-Identifier: GPL-3.0-or-later
// Factorisations and products against dense algebra.
#include <gtest/gtest.h>

#include "core/dense/cholesky.hpp"
#include "core/sparse/factor/inertia.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/symmetric_product.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::sparse {
namespace {

using test::diagonal;
using test::spring_box;

SparseMatrix held_box(int n) {
  const auto box = spring_box(n, n, n);
  return box.K + 1e6 * box.M;
}

TEST(Factor, SolvesAgreeWithDenseAlgebra) {
  const SparseMatrix A = held_box(4);
  const SparseMatrix full = A.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd b = test::random_matrix(A.rows(), 70);  // more than one block of 64
  const SupernodalFactor factor(A);
  const Eigen::MatrixXd expected = dense::Cholesky(Eigen::MatrixXd(full)).solve(b);
  const double error = (factor.solve(b) - expected).norm() / expected.norm();
  EXPECT_LT(error, 1e-11);  // condition of A is about 1e4
}

TEST(Factor, ReportsTheFillAndAnExactProbe) {
  const SupernodalFactor factor(held_box(5));
  EXPECT_EQ(factor.report().ordering, "metis");
  EXPECT_GT(factor.report().entries, factor.size());
  EXPECT_LT(factor.report().probe_residual, 1e-12);
}

TEST(Factor, AGivenPermutationIsReusedWithTheSameFill) {  // hard case C7, partly
  const SparseMatrix A = held_box(5);
  const SupernodalFactor first(A);
  FactorOptions options;
  options.permutation = first.permutation();
  const SupernodalFactor second(A, options);
  EXPECT_EQ(second.report().ordering, "given");
  EXPECT_EQ(second.report().entries, first.report().entries);
}

TEST(Factor, UnitsDoNotChangeTheVerdict) {
  // Rotations in rad and displacements in m differ by many powers of ten.
  SparseMatrix A = held_box(4);
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(A.rows());
  for (int i = 0; i < unit.size(); i += 3) unit[i] = 1e-9;
  const SparseMatrix scaled = unit.asDiagonal() * A * unit.asDiagonal();
  EXPECT_NO_THROW(SupernodalFactor{scaled});
}

TEST(SymmetricProductTest, EqualsTheDenseProductForStridedBlocks) {
  const auto box = spring_box(3, 3, 4);
  const SparseMatrix full = box.K.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd big = test::random_matrix(box.K.rows() + 7, 13);
  const auto x = big.topRows(box.K.rows());
  const Eigen::MatrixXd expected = Eigen::MatrixXd(full) * x;
  const SymmetricProduct product(box.K);
  EXPECT_LT((product * Eigen::MatrixXd(x) - expected).norm(), 1e-12 * expected.norm());
}

TEST(Inertia, CountsNegativeEntriesOfADiagonal) {
  const SparseMatrix K = diagonal(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  const SparseMatrix M = diagonal(Eigen::Vector4d::Ones());
  EXPECT_EQ(count_below(K, M, 0.5).negative, 0);
  EXPECT_EQ(count_below(K, M, 2.5).negative, 2);
  EXPECT_EQ(count_below(K, M, 9.0).negative, 4);
}

TEST(Inertia, SeesThatTheLimitIsAnEigenvalue) {
  const SparseMatrix K = diagonal(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  const SparseMatrix M = diagonal(Eigen::Vector4d::Ones());
  EXPECT_EQ(count_below(K, M, 3.0).zero, 1);
}

}  // namespace
}  // namespace clatter::sparse
