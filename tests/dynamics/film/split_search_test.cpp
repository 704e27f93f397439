// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/split_search.hpp"

#include <gtest/gtest.h>

namespace clatter::film {
namespace {

TEST(SplitSearch, ChangesAllStatesUntilASplitReturns) {
  SplitSearch search;
  search.start();
  EXPECT_EQ(search.count({1, 4}), 2u);
  EXPECT_EQ(search.count({2, 4}), 2u);
  EXPECT_EQ(search.count({3, 7}), 2u);
  // {1, 2, 3, 7} changed so far: these would bring {1, 4} back.
  EXPECT_EQ(search.count({2, 3, 4, 7}), 1u);
  EXPECT_EQ(search.count({3, 7}), 1u);  // as many as there were
  EXPECT_EQ(search.count({5}), 1u);     // fewer than ever: all of one
  EXPECT_EQ(search.count({6}), 1u);
  search.start();
  EXPECT_EQ(search.count({1, 2}), 2u);
  EXPECT_EQ(search.count({1, 2}), 1u);  // back at the first split
}

TEST(SplitSearch, AllStatesChangeAgainWhenFewerAreViolatedThanEver) {
  SplitSearch search;
  search.start();
  EXPECT_EQ(search.count({1, 2, 3}), 3u);
  EXPECT_EQ(search.count({1, 2, 3}), 1u);
  EXPECT_EQ(search.count({4, 5, 6}), 1u);
  EXPECT_EQ(search.count({4, 5}), 2u);
}

TEST(SplitSearch, AFrontThatMovesCellByCellNeverReturns) {
  SplitSearch search;
  search.start();
  for (int cell = 0; cell < 5000; cell += 2) ASSERT_EQ(search.count({cell, cell + 1}), 2u);
}

}  // namespace
}  // namespace clatter::film
