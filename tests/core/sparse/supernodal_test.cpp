// SPDX-License-Identifier: GPL-3.0-or-later
// Unit tests of the sparse factor: permutation, tree, sweeps, boundary, counts.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>

#include "core/base/threads.hpp"
#include "core/dense/cholesky.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/factor/front.hpp"
#include "core/sparse/factor/inertia.hpp"
#include "core/sparse/factor/mumps_inertia.hpp"
#include "core/sparse/factor/ordering.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"
#include "core/sparse/factor/tree_schedule.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::spring_box;

SparseMatrix held_box(int nx, int ny, int nz) {
  const auto box = spring_box(nx, ny, nz);
  return box.K + 1e6 * box.M;
}

MatrixXd full(const SparseMatrix& lower) {
  const SparseMatrix both = lower.selfadjointView<Eigen::Lower>();
  return MatrixXd(both);
}

TEST(Ordering, TheThreeDisplacementsOfANodeAreOneVertex) {
  // Only adjacent nodes have all nine entries of a block.
  const int nodes = 5;
  std::vector<Eigen::Triplet<double>> entries;
  for (int a = 0; a < 3 * nodes; ++a)
    for (int b = 0; b <= a; ++b)
      if (a / 3 - b / 3 <= 1) entries.emplace_back(a, b, 1.0);
  const CompressedGraph graph = compress_graph(test::from_triplets(3 * nodes, entries));
  ASSERT_EQ(graph.size(), nodes);
  EXPECT_EQ(graph.weight, std::vector<int32_t>(nodes, 3));
  EXPECT_EQ(graph.starts, (std::vector<int64_t>{0, 1, 3, 5, 7, 8}));  // a chain
  for (int i = 0; i < 3 * nodes; ++i) EXPECT_EQ(graph.vertex[i], i / 3);
}

TEST(Ordering, EveryMethodGivesAPermutation) {
  const SparseMatrix A = held_box(6, 5, 4);
  for (const Ordering method : {Ordering::kMetis, Ordering::kAmd, Ordering::kNatural}) {
    const FillOrder found = fill_reducing_order(A, method);
    EXPECT_EQ(found.method, method);
    std::vector<int32_t> sorted = found.order, all(static_cast<size_t>(A.cols()));
    std::iota(all.begin(), all.end(), 0);
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, all) << ordering_name(method);
  }
}

TEST(SupernodeTree, HoldsTheFillThatEigenCounts) {
  const SparseMatrix A = held_box(6, 6, 6);
  const SupernodeTree tree = analyse_tree(A, {});
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse(A.cols());
  for (int j = 0; j < A.cols(); ++j) inverse.indices()[tree.order[j]] = j;
  SparseMatrix turned(A.rows(), A.cols());
  turned.selfadjointView<Eigen::Lower>() = A.selfadjointView<Eigen::Lower>().twistedBy(inverse);
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> eigen(turned);
  const SparseMatrix L = eigen.matrixL();
  int64_t trapezoids = 0;
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    const int64_t p = tree.columns(s);
    trapezoids += p * (p + 1) / 2 + p * tree.below(s);
  }
  EXPECT_GE(trapezoids, L.nonZeros());
  EXPECT_LT(static_cast<double>(trapezoids), 1.6 * static_cast<double>(L.nonZeros()));  // merging
  // Every entry of L is in the front of its column.
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    for (int j = tree.first[s]; j < tree.first[static_cast<size_t>(s) + 1]; ++j)
      for (SparseMatrix::InnerIterator it(L, j); it; ++it)
        EXPECT_TRUE(std::binary_search(tree.rows_of(s), tree.rows_of(s) + tree.height(s),
                                       static_cast<int32_t>(it.row())));
}

TEST(TreeSchedule, SubtreesAndTopAreAllSupernodesOnce) {
  const SupernodeTree tree = analyse_tree(held_box(12, 9, 9), {});
  for (const int threads : {1, 2, 5}) {
    const TreeSchedule plan = schedule(tree, threads);
    std::vector<int> seen(static_cast<size_t>(tree.supernodes()), 0);
    for (const int32_t s : plan.top) ++seen[s];
    for (const int32_t root : plan.subtrees)
      for (int32_t s = plan.lowest[root]; s <= root; ++s) ++seen[s];
    EXPECT_EQ(seen, std::vector<int>(seen.size(), 1)) << threads;
    EXPECT_EQ(plan.subtrees.empty(), threads == 1);
  }
}

TEST(SweepKernel, EqualsDenseAlgebraForEverySizeOfBlock) {
  for (const int n : {1, 2, 5, 6, 7, 11, 12, 13, 23, 25, 47, 48}) {
    const int below = n + 3;
    const MatrixXd A =
        test::random_matrix(n + below, n, 1) + 3.0 * MatrixXd::Identity(n + below, n);
    const MatrixXd L = A.topRows(n).triangularView<Eigen::Lower>();
    RowMatrix x = test::random_matrix<RowMatrix>(n, kLanes, 2),
              y = test::random_matrix<RowMatrix>(below, kLanes, 3);
    const RowMatrix x0 = x, y0 = y;
    const Lanes at_x{x.data(), kLanes}, at_y{y.data(), kLanes};
    solve_lower(A.data(), A.rows(), n, at_x);
    EXPECT_LT((L * x - x0).norm(), 1e-12 * x.norm()) << n;
    subtract_product(A.data() + n, A.rows(), below, n, at_x, at_y);
    EXPECT_LT((y - (y0 - A.bottomRows(below) * x)).norm(), 1e-13 * A.norm() * x.norm()) << n;
    x = x0;
    solve_lower_transposed(A.data(), A.rows(), n, at_x);
    EXPECT_LT((L.transpose() * x - x0).norm(), 1e-12 * x.norm()) << n;
    const RowMatrix before = x;
    subtract_transposed(A.data() + n, A.rows(), below, n, at_y, at_x);
    EXPECT_LT((x - (before - A.bottomRows(below).transpose() * y)).norm(),
              1e-13 * A.norm() * y.norm())
        << n;
  }
}

TEST(SupernodalFactorTest, AnyNumberOfRightHandSidesHasTheSameAnswer) {
  const SparseMatrix A = held_box(7, 6, 5);
  const SupernodalFactor factor(A);
  const MatrixXd b = test::random_matrix(A.rows(), 300);  // more than two sweeps
  const MatrixXd all = factor.solve(b);
  EXPECT_LT((full(A) * all - b).norm(), 1e-11 * b.norm());
  for (const Index count : {1, 2, 7, 8, 9, 130})
    EXPECT_LT((factor.solve(b.leftCols(count)) - all.leftCols(count)).norm(),
              1e-12 * all.leftCols(count).norm())
        << count;
}

TEST(SupernodalFactorTest, RepeatedRunsHaveTheSameBits) {
  const SparseMatrix A = held_box(12, 9, 9);  // large enough for subtrees on two threads
  const MatrixXd b = test::random_matrix(A.rows(), 16);
  set_thread_count(2);
  const MatrixXd once = SupernodalFactor(A).solve(b);
  const MatrixXd again = SupernodalFactor(A).solve(b);
  set_thread_count(0);
  EXPECT_EQ((once - again).cwiseAbs().maxCoeff(), 0.0);
}

/// Calls body(threads) with the thread count set.
template <class Body>
void for_thread_counts(std::initializer_list<int> counts, Body&& body) {
  for (const int threads : counts) {
    set_thread_count(threads);
    body(threads);
  }
  set_thread_count(0);
}

TEST(SupernodalFactorTest, SubtreesOfTheThreadsAndTheTopSolveTogether) {
  const SparseMatrix A = held_box(12, 9, 9);
  const MatrixXd b = test::random_matrix(A.rows(), 24), exact = dense::Cholesky(full(A)).solve(b);
  for_thread_counts({1, 2, 3, 5}, [&](int threads) {
    const SupernodalFactor factor(A);
    const TreeSchedule plan = schedule(factor.tree(), threads);
    EXPECT_EQ(plan.subtrees.empty(), threads == 1) << "nothing runs side by side";
    for (const Index count : {1, 8, 24})
      EXPECT_LT((factor.solve(b.leftCols(count)) - exact.leftCols(count)).norm(),
                1e-12 * exact.leftCols(count).norm())
          << threads << " threads, " << count;
  });
}

TEST(SupernodalFactorTest, LoadsComeToTheBoundaryByTheForwardSweepAlone) {
  const MatrixXd dense = full(held_box(9, 8, 7));
  const Index n_b = 25, n = dense.cols() - n_b;
  const SparseMatrix inside = dense.topLeftCorner(n, n).sparseView();
  const SparseMatrix coupling = dense.topRightCorner(n, n_b).sparseView();
  const MatrixXd f = test::random_matrix(n, 130);
  const MatrixXd expected = dense.topRightCorner(n, n_b).transpose() *
                            clatter::dense::Cholesky(dense.topLeftCorner(n, n)).solve(f);
  for_thread_counts({1, 2, 3}, [&](int threads) {
    const SupernodalFactor factor(inside, coupling);
    for (const Index count : {1, 5, 130})
      EXPECT_LT((factor.boundary_product(f.leftCols(count)) - expected.leftCols(count)).norm(),
                1e-12 * expected.leftCols(count).norm())
          << threads << " threads, " << count;
  });
}

TEST(SupernodalFactorTest, TheBoundaryComesWithTheElimination) {
  const SparseMatrix A = held_box(6, 6, 5);
  const MatrixXd dense = full(A);
  const Index n_b = 25, n = A.cols() - n_b;
  const SparseMatrix inside = A.topLeftCorner(n, n);
  const SparseMatrix coupling = dense.topRightCorner(n, n_b).sparseView();
  const SupernodalFactor factor(inside, coupling);
  const MatrixXd expected =
      MatrixXd(coupling).transpose() *
      clatter::dense::Cholesky(dense.topLeftCorner(n, n)).solve(MatrixXd(coupling));
  EXPECT_LT((factor.boundary_part() - expected).norm(), 1e-12 * expected.norm());
  const MatrixXd b = test::random_matrix(n, 3);  // the boundary rows are not part of the solves
  EXPECT_LT((dense.topLeftCorner(n, n) * factor.solve(b) - b).norm(), 1e-11 * b.norm());
}

TEST(Inertia, OwnPivotsAndThoseOfMumpsCountTheSame) {
  const auto box = spring_box(8, 6, 5);
  const VectorXd values =
      dense::symmetric_eigen(full(box.K), full(box.M), dense::EigenParts::kValues).values;
  int compared = 0, by_own = 0;
  for (Index j = 7; j < values.size(); j += 23) {  // far into the indefinite range, too
    if (values[j] - values[j - 1] < 1e-6 * values[j]) continue;
    const double mu = 0.5 * (values[j] + values[j - 1]);
    const InertiaCount own = count_below(box.K, box.M, mu);
    EXPECT_EQ(own.negative, j);
    by_own += own.by_mumps ? 0 : 1;
    EXPECT_EQ(count_below_by_mumps(box.K, box.M, mu).negative, j);
    ++compared;
  }
  EXPECT_GT(compared, 20);
  EXPECT_GT(by_own, 15);  // so that the comparison is meaningful
}

/// A front with two pivots above one row.
struct SmallFront {
  std::vector<double> panel;  // columns (a11, a21, a31), (., a22, a32)
  std::vector<double> update;
  Front front() { return {2, 1, panel.data(), update.data()}; }
};

TEST(FrontTest, ADefiniteBlockIsEliminatedByBothKernelsAlike) {
  // [4 2; 2 5], below it (6, 7): 20 - (6, 7) [4 2; 2 5]^{-1} (6, 7)^T = 20 - 13 = 7.
  SmallFront one{{4.0, 2.0, 6.0, 0.0, 5.0, 7.0}, {20.0}}, two = one;
  EXPECT_EQ(eliminate_definite(one.front()), 0);
  const PivotSigns signs = eliminate_symmetric(two.front());
  EXPECT_NEAR(one.update[0], 7.0, 1e-13);
  EXPECT_NEAR(two.update[0], 7.0, 1e-13);
  EXPECT_EQ(signs.negative + signs.zero, 0);
}

TEST(FrontTest, AnIndefiniteBlockIsPivotedAndItsGrowthReported) {
  // [0 1; 1 0] has one negative eigenvalue; 5 - (2, 3) [0 1; 1 0] (2, 3)^T = -7.
  SmallFront swap{{0.0, 1.0, 2.0, 0.0, 0.0, 3.0}, {5.0}};
  SmallFront refused = swap;
  EXPECT_EQ(eliminate_definite(refused.front()), 1);
  const PivotSigns signs = eliminate_symmetric(swap.front());
  EXPECT_EQ(signs.negative, 1);
  EXPECT_NEAR(swap.update[0], -7.0, 1e-13);
  EXPECT_NEAR(signs.growth, 3.0, 1e-13);
  // A nearly singular block: the following pivots are unreliable.
  SmallFront near{{-1.0, 0.0, 0.0, 0.0, 1e-9, 1.0}, {1.0}};
  EXPECT_NEAR(eliminate_symmetric(near.front()).growth, 1e9, 1e-3);
  SmallFront barely{{1.0, 0.0, 0.0, 0.0, 1e-8, 1.0}, {1.0}};  // Cholesky accepts it silently
  EXPECT_NEAR(eliminate_symmetric(barely.front()).growth, 1e4, 1e-8);
  SmallFront zero{{-1.0, 0.0, 0.0, 0.0, 0.0, 1.0}, {1.0}};
  EXPECT_EQ(eliminate_symmetric(zero.front()).zero, 1);
}

}  // namespace
}  // namespace clatter::sparse
