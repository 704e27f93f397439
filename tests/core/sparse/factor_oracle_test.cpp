// SPDX-License-Identifier: GPL-3.0-or-later
// The multifrontal factor entry by entry: dense Cholesky, and CHOLMOD's simplicial factor of the
// same permuted matrix.
#include <cholmod.h>
#include <gtest/gtest.h>

#include <random>

#include "core/dense/cholesky.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::sparse {
namespace {

/// A random sparse matrix, diagonally dominant, lower triangle: `per_row` couplings of each row.
SparseMatrix dominant_matrix(int n, int per_row, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> column(0, n - 1);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < per_row; ++k) {
      const int j = column(random);
      if (j != i) full(i, j) = full(j, i) = value(random);
    }
  for (int i = 0; i < n; ++i) full(i, i) = full.row(i).cwiseAbs().sum() + 0.1 * (1 + i % 7);
  SparseMatrix lower = Eigen::MatrixXd(full.triangularView<Eigen::Lower>()).sparseView();
  lower.makeCompressed();
  return lower;
}

/// P S A S P^T, both triangles.
Eigen::MatrixXd permuted(const SparseMatrix& lower, const SupernodalFactor& factor) {
  const Eigen::MatrixXd A = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  const auto order = factor.permutation();
  Eigen::MatrixXd B(A.rows(), A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.rows(); ++j) {
      const auto row = order[i], column = order[j];
      B(i, j) = factor.scale()[row] * A(row, column) * factor.scale()[column];
    }
  return B;
}

/// The panels of L as one dense lower triangle.
Eigen::MatrixXd dense_factor(const SupernodalFactor& factor) {
  const FactorView view = factor.view();
  const SupernodeTree& tree = *view.tree;
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(tree.size, tree.size);
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    const double* panel = view.panels + tree.panel_start[s];
    const int32_t first = tree.first[s];
    for (int32_t c = 0; c < tree.columns(s); ++c)
      for (int32_t r = c; r < tree.height(s); ++r)
        L(tree.rows_of(s)[r], first + c) = panel[c * tree.height(s) + r];
  }
  return L;
}

/// L and D of CHOLMOD's simplicial L D L^T in the given order.
struct SimplicialFactor {
  Eigen::MatrixXd L;
  Eigen::VectorXd D;
};

SimplicialFactor simplicial_factor(const Eigen::MatrixXd& B) {
  cholmod_common common;
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SIMPLICIAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 0;
  cholmod_dense* dense =
      cholmod_allocate_dense(static_cast<size_t>(B.rows()), static_cast<size_t>(B.rows()),
                             static_cast<size_t>(B.rows()), CHOLMOD_REAL, &common);
  std::copy_n(B.data(), B.size(), static_cast<double*>(dense->x));
  cholmod_sparse* full = cholmod_dense_to_sparse(dense, 1, &common);
  cholmod_sparse* lower = cholmod_copy(full, -1, 1, &common);
  cholmod_factor* factor = cholmod_analyze(lower, &common);
  cholmod_factorize(lower, factor, &common);
  EXPECT_EQ(common.status, CHOLMOD_OK);
  EXPECT_EQ(factor->is_ll, 0);
  SimplicialFactor out{Eigen::MatrixXd::Identity(B.rows(), B.rows()), Eigen::VectorXd(B.rows())};
  const int *start = static_cast<int*>(factor->p), *count = static_cast<int*>(factor->nz),
            *row = static_cast<int*>(factor->i);
  const double* value = static_cast<double*>(factor->x);
  for (int c = 0; c < static_cast<int>(B.rows()); ++c) {
    out.D[c] = value[start[c]];
    for (int k = 1; k < count[c]; ++k) out.L(row[start[c] + k], c) = value[start[c] + k];
  }
  cholmod_free_factor(&factor, &common);
  cholmod_free_sparse(&lower, &common);
  cholmod_free_sparse(&full, &common);
  cholmod_free_dense(&dense, &common);
  cholmod_finish(&common);
  return out;
}

class FactorOracle : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(FactorOracle, EveryEntryIsThatOfDenseCholeskyAndOfCholmod) {
  const auto [n, per_row] = GetParam();
  const SparseMatrix A = dominant_matrix(n, per_row, 17);
  const SupernodalFactor factor(A);
  const Eigen::MatrixXd B = permuted(A, factor), L = dense_factor(factor);
  const double size = L.cwiseAbs().maxCoeff();

  const Eigen::MatrixXd reference = dense::Cholesky(B).lower();
  EXPECT_LT((L - reference).cwiseAbs().maxCoeff(), 1e-14 * size);

  const SimplicialFactor cholmod = simplicial_factor(B);
  const Eigen::VectorXd D = L.diagonal().array().square();
  EXPECT_LT((D - cholmod.D).cwiseAbs().maxCoeff(), 1e-14 * cholmod.D.maxCoeff());
  const Eigen::MatrixXd unit = L * L.diagonal().cwiseInverse().asDiagonal();
  EXPECT_LT((unit - cholmod.L).cwiseAbs().maxCoeff(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FactorOracle,
                         testing::Values(std::tuple{1, 0}, std::tuple{2, 1}, std::tuple{7, 2},
                                         std::tuple{40, 1}, std::tuple{40, 39}, std::tuple{150, 3},
                                         std::tuple{300, 2}));

}  // namespace
}  // namespace clatter::sparse
