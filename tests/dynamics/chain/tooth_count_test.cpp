// SPDX-License-Identifier: GPL-3.0-or-later
// Jumps of a chain over the teeth of a sprocket.
#include "dynamics/chain/tooth_count.hpp"

#include <gtest/gtest.h>

namespace clatter::dynamics {
namespace {

constexpr int kLinks = 14, kTeeth = 9, kNone = -1;

/// Links on a sprocket that has turned by `turned` gaps, the chain ahead of it by some teeth: three
/// of them lie in gaps, every other one.
std::vector<int> gaps(int turned, int ahead, Turn turn) {
  std::vector<int> found(kLinks, kNone);
  const int s = static_cast<int>(turn);
  for (int k = -2; k <= 2; k += 2) {
    // Link j is at the place j + turned + ahead along the way of the chain in space.
    const int link = ((k - turned - ahead) % kLinks + kLinks) % kLinks;
    found[link] = (((s * (k - turned)) % kTeeth) + kTeeth) % kTeeth;
  }
  return found;
}

class Turning : public ::testing::TestWithParam<Turn> {};

TEST_P(Turning, CountsNothingWhileTheChainRunsForwardsAndBackwards) {
  ToothCount count(kLinks, kTeeth, GetParam(), 0, 0);
  for (int turned = 0; turned < 300; ++turned) count.update(turned, gaps(turned, 0, GetParam()));
  for (int turned = 300; turned > -300; --turned) count.update(turned, gaps(turned, 0, GetParam()));
  EXPECT_EQ(count.jumped(), 0);
}

TEST_P(Turning, CountsTeethByTheirSignWithTheTimeOfTheFirst) {
  ToothCount count(kLinks, kTeeth, GetParam(), 0, 0);
  int turned = 0;
  for (; turned < 50; ++turned) count.update(turned, gaps(turned, 0, GetParam()));
  for (; turned < 100; ++turned) count.update(turned, gaps(turned, -1, GetParam()));
  for (; turned < 150; ++turned) count.update(turned, gaps(turned, -2, GetParam()));
  EXPECT_EQ(count.ahead(), -2);
  for (; turned < 200; ++turned) count.update(turned, gaps(turned, 1, GetParam()));
  EXPECT_EQ(count.ahead(), 1);
  EXPECT_EQ(count.jumped(), 5);
  EXPECT_EQ(count.first_time(), 50.0);
}

INSTANTIATE_TEST_SUITE_P(Turns, Turning,
                         ::testing::Values(Turn::kClockwise, Turn::kCounterClockwise));

TEST(ToothCount, AJumpCountsWhenAllLinksHaveJumpedAndIsFoundWithTheFirst) {
  ToothCount count(kLinks, kTeeth, Turn::kCounterClockwise, 0, 0);
  count.update(0.0, gaps(0, 0, Turn::kCounterClockwise));
  std::vector<int> one = gaps(0, 0, Turn::kCounterClockwise);
  one[2] = (one[2] + 1) % kTeeth;
  count.update(1.0, one);
  EXPECT_EQ(count.jumped(), 0);
  for (int& gap : one) gap = gap == kNone ? kNone : (gap + 1) % kTeeth;
  one[2] = (one[2] + kTeeth - 1) % kTeeth;
  count.update(2.0, one);
  EXPECT_EQ(count.ahead(), 1);
  EXPECT_EQ(count.first_time(), 1.0);
}

TEST(ToothCount, ALinkThatRidesUpAndFallsBackHasNotJumped) {
  ToothCount count(kLinks, kTeeth, Turn::kCounterClockwise, 0, 0);
  const std::vector<int> seated = gaps(0, 0, Turn::kCounterClockwise);
  std::vector<int> one = seated;
  one[2] = (one[2] + 1) % kTeeth;
  count.update(0.0, one);
  count.update(1.0, seated);
  EXPECT_EQ(count.jumped(), 0);
  EXPECT_LT(count.first_time(), 0.0);
}

TEST(ToothCount, GoesOnFromWhatItSaved) {
  ToothCount one(kLinks, kTeeth, Turn::kClockwise, 0, 0), two = one;
  int turned = 0;
  for (; turned < 50; ++turned)
    one.update(turned, gaps(turned, turned < 20 ? 0 : 1, Turn::kClockwise));
  two.restore(one.save());
  for (; turned < 100; ++turned) {
    one.update(turned, gaps(turned, 2, Turn::kClockwise));
    two.update(turned, gaps(turned, 2, Turn::kClockwise));
  }
  EXPECT_EQ(two.jumped(), 2);
  EXPECT_EQ(two.save(), one.save());
}

}  // namespace
}  // namespace clatter::dynamics
