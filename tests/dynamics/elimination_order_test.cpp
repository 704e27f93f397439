// SPDX-License-Identifier: GPL-3.0-or-later
// Rounds, parents and couplings of an elimination.
#include "dynamics/integrate/elimination_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace clatter::dynamics {
namespace {

TEST(EliminationOrder, AChainIsHalvedRoundByRound) {
  // A ring of 64 nodes: in each round every second one goes, coupled with two others at most.
  constexpr int kNodes = 64;
  EliminationOrder order(std::vector<int>(kNodes, 3), std::vector<char>(kNodes, 0));
  for (int k = 0; k < kNodes; ++k) order.couple(std::vector{k, (k + 1) % kNodes});
  order.find();
  ASSERT_EQ(order.steps().size(), kNodes);
  std::vector<int> depth(kNodes, 1);
  for (size_t k = 0; k < kNodes; ++k) {
    const EliminationOrder::Step& step = order.steps()[k];
    EXPECT_LE(step.count, 2);
    EXPECT_EQ(order.step_of(step.node), k);
    if (step.parent < 0) continue;
    const auto parent = static_cast<size_t>(step.parent);
    EXPECT_GT(parent, k);
    depth[parent] = std::max(depth[parent], depth[k] + 1);
  }
  EXPECT_LE(depth.back(), 8);
}

TEST(EliminationOrder, NodesThatStayAreLeft) {
  EliminationOrder order({3, 3, 40}, {0, 0, 1});
  for (int turn = 0; turn < 2; ++turn) {
    order.clear();
    order.couple(std::vector{0, 2});
    if (turn == 1) order.couple(std::vector{0, 1});
    order.find();
    ASSERT_EQ(order.steps().size(), 2);
    EXPECT_EQ(order.step_of(2), -1);
    int couplings = 0;
    for (const auto& step : order.steps()) couplings += step.count;
    EXPECT_EQ(couplings, 1 + turn);
  }
}

}  // namespace
}  // namespace clatter::dynamics
