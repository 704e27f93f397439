// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the ranks, also where there are more ranks than rows.
#include <gtest/gtest.h>

#include "core/ranks/index_places.hpp"
#include "core/ranks/mumps_factor.hpp"
#include "tests/core/ranks/all_ranks.hpp"

namespace clatter::ranks {
namespace {

using Eigen::MatrixXd;

TEST(RowShares, EveryIndexHasOneOwnerAndItsRow) {
  for (const auto& [interior, boundary, count] :
       {std::array{10, 3, 4}, {2, 1, 4}, {1, 0, 7}, {5, 9, 3}, {100, 1, 32}}) {
    const RowShares shares(interior, boundary, count);
    int64_t seen = 0;
    for (int rank = 0; rank < count; ++rank) {
      const std::vector<int64_t> rows = shares.rows_of(rank, true);
      for (size_t k = 0; k < rows.size(); ++k) {
        EXPECT_EQ(shares.owner(rows[k]), rank);
        EXPECT_EQ(shares.local(rows[k]), static_cast<int64_t>(k));
        EXPECT_EQ(shares.local(rows[k], rank), static_cast<int64_t>(k));
        for (int other = 0; other < count; ++other)
          EXPECT_EQ(shares.owns(other, rows[k]), other == rank);
      }
      seen += static_cast<int64_t>(rows.size());
    }
    EXPECT_EQ(seen, interior + boundary);
  }
}

TEST(IndexPlaces, NumbersWhatWasAddedAscending) {
  IndexPlaces places(10);
  for (const int index : {7, 2, 7, 9}) places.add(index);
  EXPECT_EQ(places.number(), (std::vector<int64_t>{2, 7, 9}));
  EXPECT_EQ(places[2], 0);
  EXPECT_EQ(places[7], 1);
  EXPECT_EQ(places[9], 2);
}

/// The own rows of a chain of springs k between `size` masses, the first held by another spring;
/// both triangles.
Entries chain(const Ranks& ranks, const RowShares& shares, double k) {
  Entries own;
  const auto last = static_cast<int32_t>(shares.size()) - 1;
  for (const int64_t i : shares.rows_of(ranks.rank(), true)) {
    const auto row = static_cast<int32_t>(i);
    if (row > 0) own.push_back({row, row - 1, -k});
    own.push_back({row, row, row == last ? k : 2.0 * k});
    if (row < last) own.push_back({row, row + 1, -k});
  }
  return own;
}

TEST(MoreRanksThanUnknowns, FactorSolvesAndSchurComplementAreThoseByHand) {
  // Two unknowns and one boundary coordinate on four ranks, two of them without rows.
  const Ranks& ranks = test::all_ranks();
  ASSERT_GT(ranks.size(), 2);
  const RowShares shares(2, 1, ranks.size());
  const double k = 1e6;
  const Entries K = chain(ranks, shares, k);
  const MumpsFactor factor(ranks, shares, {K, K, 0.0}, Extent::kInteriorToBoundary, {});
  ASSERT_EQ(factor.boundary_part().size(), 1);
  // C^T K_ii^{-1} C = k^2 [K_ii^{-1}]_22 = k^2 2 / (3 k); K_bb = k less that: three springs in row.
  EXPECT_NEAR(factor.boundary_part()(0, 0), 2.0 / 3.0 * k, 1e-9 * k);
  const std::vector<int64_t> own = shares.rows_of(ranks.rank(), false);
  MatrixXd b(static_cast<Eigen::Index>(own.size()), 2);
  for (size_t j = 0; j < own.size(); ++j)
    b.row(static_cast<Eigen::Index>(j)) << (own[j] == 0 ? 1.0 : 0.0), 1.0;
  const MatrixXd x = factor.solve(b);
  ASSERT_EQ(x.rows(), b.rows());
  for (size_t j = 0; j < own.size(); ++j) {
    // K_ii^{-1} = [2 1; 1 2] / (3 k).
    EXPECT_NEAR(k * x(static_cast<Eigen::Index>(j), 0), own[j] == 0 ? 2.0 / 3.0 : 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(k * x(static_cast<Eigen::Index>(j), 1), 1.0, 1e-12);
  }
  const MatrixXd forward = factor.boundary_product(b);
  EXPECT_NEAR(forward(0, 0), -1.0 / 3.0, 1e-12);  // C^T K_ii^{-1} e_1
}

}  // namespace
}  // namespace clatter::ranks
