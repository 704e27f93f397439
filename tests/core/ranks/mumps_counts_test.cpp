// SPDX-License-Identifier: GPL-3.0-or-later
// Counts of MUMPS beyond 32 bits.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/ranks/mumps_impl.hpp"
#include "tests/core/ranks/all_ranks.hpp"
#include "tests/refusal.hpp"

namespace clatter::ranks {
namespace {

TEST(HardC4, NegativeCountsOfMumpsAreMillions) {
  EXPECT_EQ(count_of(0), 0);
  EXPECT_EQ(count_of(2147483647), 2147483647);
  EXPECT_EQ(count_of(-2148), int64_t{2148000000});
  EXPECT_EQ(count_of(-2147483647), int64_t{2147483647} * 1000000);
}

/// The own rows of a star of n masses: the first is joined to all others.
Entries star(const Ranks& ranks, const RowShares& shares) {
  Entries own;
  const auto n = static_cast<int32_t>(shares.size());
  for (const int64_t row : shares.rows_of(ranks.rank(), false)) {
    const auto i = static_cast<int32_t>(row);
    if (i == 0) {
      own.push_back({0, 0, static_cast<double>(n)});
      for (int32_t j = 1; j < n; ++j) own.push_back({0, j, -1.0});
    } else {
      own.push_back({i, 0, -1.0});
      own.push_back({i, i, 2.0});
    }
  }
  return own;
}

TEST(HardC4, MumpsCountsFactorsBeyond32BitsAndTheyAreRefusedBeforeTheyAreMade) {
  // With the centre of the star eliminated first, L is dense: n (n + 1) / 2 entries.
  const Ranks& ranks = test::all_ranks();
  const int64_t n = 66000;
  const RowShares shares(n, 0, ranks.size());
  const Entries K = star(ranks, shares);
  sparse::FactorOptions options;
  options.memory_limit_gib = 0.5;
  const std::string refused = test::refusal_of<NumericsError>([&] {
    const MumpsFactor factor(ranks, shares, {K, K, 0.0}, Extent::kInterior, options);
  });
  test::expect_parts(refused, {"the factor of 66000 unknowns needs", "512 MiB are left"});
  const size_t end = refused.find(" entries)"), begin = refused.rfind('(', end) + 1;
  ASSERT_NE(end, std::string::npos) << refused;
  const double entries = std::stod(refused.substr(begin, end - begin));
  EXPECT_GT(entries, 2147483648.0);
  EXPECT_NEAR(entries, 0.5 * static_cast<double>(n * (n + 1)), 1e6);  // given in millions
}

TEST(HardC4, ABoundaryWhoseSchurComplementCannotBeCountedIsRefused) {
  const Ranks& ranks = test::all_ranks();
  const RowShares shares(10, 46341, ranks.size());
  Entries K;
  for (const int64_t row : shares.rows_of(ranks.rank(), true))
    K.push_back({static_cast<int32_t>(row), static_cast<int32_t>(row), 1.0});
  test::expect_parts(
      test::refusal_of<NumericsError>([&] {
        const MumpsFactor factor(ranks, shares, {K, K, 0.0}, Extent::kInteriorToBoundary, {});
      }),
      {"found 46341 boundary coordinates, expected at most 46340"});
}

}  // namespace
}  // namespace clatter::ranks
