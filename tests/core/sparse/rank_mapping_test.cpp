// SPDX-License-Identifier: GPL-3.0-or-later
// Counts of a factorisation from the graph alone, and its mapping to ranks.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numeric>

#include "core/sparse/factor/ordering.hpp"
#include "core/sparse/factor/rank_mapping.hpp"
#include "tests/core/sparse/spring_models.hpp"

namespace clatter::sparse {
namespace {

using test::spring_box;

/// Entries of Eigen's L of A with the rows in `order`.
int64_t eigen_entries(const SparseMatrix& lower, const std::vector<int32_t>& order) {
  Eigen::VectorXi place(lower.cols());
  for (int k = 0; k < lower.cols(); ++k) place[order[k]] = k;
  SparseMatrix permuted(lower.rows(), lower.cols());
  permuted.selfadjointView<Eigen::Lower>() =
      lower.selfadjointView<Eigen::Lower>().twistedBy(place.asPermutation());
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> llt(permuted);
  EXPECT_EQ(llt.info(), Eigen::Success);
  return llt.matrixL().nestedExpression().nonZeros();
}

double sum_of(const std::vector<RankLoad>& load, double RankLoad::*value) {
  return std::accumulate(load.begin(), load.end(), 0.0,
                         [&](double sum, const RankLoad& one) { return sum + one.*value; });
}

TEST(FrontSizes, OneDenseNodeWithTwoBoundaryColumnsByHand) {
  SparseMatrix A(3, 3), C(3, 2);
  for (int j = 0; j < 3; ++j)
    for (int i = j; i < 3; ++i) A.insert(i, j) = i == j ? 2.0 : 0.1;
  for (int b = 0; b < 2; ++b) C.insert(b, b) = 1.0;
  const FrontSizes fronts = count_fronts(A, C);
  ASSERT_EQ(fronts.fronts(), 1);
  EXPECT_EQ(fronts.columns[0], 3);
  EXPECT_EQ(fronts.height[0], 5);
  EXPECT_EQ(fronts.entries(), 5 + 4 + 3);
  EXPECT_EQ(fronts.flops(), 25.0 + 16.0 + 9.0);
}

TEST(FrontSizes, EntriesAreThoseOfEigensFactorInTheSameOrder) {
  for (const int n : {3, 6, 9}) {
    auto box = spring_box(n, n, n + 1);
    const SparseMatrix A = box.K + box.M;
    const std::vector<int32_t> order = fill_reducing_order(A, Ordering::kMetis).order;
    const FrontSizes fronts = count_fronts(A);
    EXPECT_EQ(fronts.entries(), eigen_entries(A, order)) << n;
    EXPECT_EQ(std::accumulate(fronts.columns.begin(), fronts.columns.end(), int64_t{0}), A.cols());
    EXPECT_EQ(fronts.ordering, "metis");
  }
}

TEST(FrontSizes, TheBoundarysRowsAreThoseOfTheFactorOfAllWithTheBoundaryLast) {
  auto box = spring_box(5, 5, 5);
  const SparseMatrix A = box.K + box.M;
  const int n_b = 7, n = static_cast<int>(A.cols());
  std::vector<Eigen::Triplet<double>> coupling, all;
  for (int b = 0; b < n_b; ++b)
    for (int k = 0; k < 3; ++k) coupling.emplace_back((b * 41) % (n / 3) * 3 + k, b, 1e-3);
  SparseMatrix C(n, n_b);
  C.setFromTriplets(coupling.begin(), coupling.end());
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) all.emplace_back(it.row(), j, it.value());
  for (const auto& entry : coupling) all.emplace_back(n + entry.col(), entry.row(), entry.value());
  for (int b = 0; b < n_b; ++b) all.emplace_back(n + b, n + b, 1e9);
  std::vector<int32_t> order = fill_reducing_order(A, Ordering::kMetis).order;
  for (int b = 0; b < n_b; ++b) order.push_back(n + b);
  const int64_t dense = n_b * (n_b + 1) / 2;  // the Schur complement of a connected body
  EXPECT_EQ(count_fronts(A, C).entries() + dense,
            eigen_entries(test::from_triplets(n + n_b, all), order));
}

TEST(RankMapping, EightSubtreesByHand) {
  FrontSizes fronts;  // leaves of 200 columns under a root of 50
  fronts.columns.assign(8, 200);
  fronts.height.assign(8, 250);
  fronts.parent.assign(8, 8);
  fronts.columns.push_back(50);
  fronts.height.push_back(50);
  fronts.parent.push_back(-1);
  const std::vector<RankLoad> two = map_to_ranks(fronts, 2);
  const double leaf = 200.0 * 201.0 / 2.0 + 200.0 * 50.0, root = 50.0 * 51.0 / 2.0;
  EXPECT_EQ(two[0].entries + two[1].entries, 8.0 * leaf + root);
  EXPECT_EQ(std::abs(two[0].entries - two[1].entries), root);  // four leaves each, one the root too
  EXPECT_EQ(sum_of(two, &RankLoad::sent), 4.0 * 50.0 * 51.0 / 2.0);  // update matrices of four
  const std::vector<RankLoad> one = map_to_ranks(fronts, 1);
  EXPECT_EQ(one[0].sent, 0.0);
  // Largest at the last leaf: columns and update matrices of the others, and the front.
  EXPECT_EQ(one[0].peak, 7.0 * (leaf + 50.0 * 50.0) + 250.0 * 250.0);
}

TEST(RankMapping, AnyNumberOfRanksDoesAllTheWorkOnce) {
  auto box = spring_box(14, 14, 14);
  const FrontSizes fronts = count_fronts(box.K + box.M);
  double before = 0.0;
  for (const int ranks : {1, 2, 3, 8, 32, 5000}) {
    const std::vector<RankLoad> load = map_to_ranks(fronts, ranks);
    ASSERT_EQ(load.size(), static_cast<size_t>(ranks));
    EXPECT_NEAR(sum_of(load, &RankLoad::flops) / fronts.flops(), 1.0, 1e-12);
    EXPECT_NEAR(sum_of(load, &RankLoad::entries) / static_cast<double>(fronts.entries()), 1.0,
                1e-12);
    double most = 0.0;
    for (const RankLoad& one : load) {
      most = std::max(most, one.flops);
      EXPECT_GE(one.peak, one.entries);
    }
    EXPECT_GE(most * ranks, fronts.flops() * (1.0 - 1e-12));
    if (ranks > 1 && ranks <= 8) {
      EXPECT_LT(most, 0.75 * before);
    }
    before = ranks == 1 ? fronts.flops() : most;
    if (ranks > 1) {
      EXPECT_GT(sum_of(load, &RankLoad::sent), 0.0);
    }
  }
}

}  // namespace
}  // namespace clatter::sparse
