// SPDX-License-Identifier: GPL-3.0-or-later
// Creep at rest, by hand.
#include "dynamics/law/creep_watch.hpp"

#include <gtest/gtest.h>

#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

/// Steps of 1 s.
struct Watched {
  CreepWatch watch{0.1, 2};
  double time = 0.0;
  void step(double x, double y = 0.0, bool is_pressed = true, size_t contact = 0) {
    watch.begin_step(time);
    watch.accept_step(contact, time += 1.0, is_pressed, {x, y});
  }
};

TEST(CreepWatch, HasTheLongestWayOfARest) {
  Watched one;
  for (int k = 0; k < 3; ++k) one.step(0.03, 0.04);
  EXPECT_DOUBLE_EQ(one.watch.longest(), 0.15);
  one.step(0.2);  // it slides: that way is none of creep
  EXPECT_DOUBLE_EQ(one.watch.longest(), 0.15);
  one.step(0.09);
  one.step(0.09, 0.0, false);  // it is lifted
  one.step(0.09);
  EXPECT_DOUBLE_EQ(one.watch.longest(), 0.15);
  one.step(0.09);
  EXPECT_DOUBLE_EQ(one.watch.longest(), 0.18);
}

TEST(CreepWatch, VibrationAboutAPlaceIsNoCreepAndContactsCountByThemselves) {
  Watched one;
  for (int k = 0; k < 100; ++k) one.step(k % 2 == 0 ? 0.05 : -0.05);
  EXPECT_NEAR(one.watch.longest(), 0.05, 1e-15);
  one.step(0.04, 0.0, true, 1);
  EXPECT_NEAR(one.watch.longest(), 0.05, 1e-15);
}

TEST(CreepWatch, GoesOnFromAnArchive) {
  Watched one, other;
  one.step(0.05);
  Archive saved;
  one.watch.archive(saved);
  const std::vector<double> numbers = std::move(saved).numbers();
  Archive restored(numbers);
  other.watch.archive(restored);
  EXPECT_TRUE(restored.is_used_up());
  for (Watched* each : {&one, &other}) each->step(0.05);
  EXPECT_EQ(other.watch.longest(), one.watch.longest());
  Archive cut({numbers.begin(), numbers.end() - 1});
  EXPECT_NE(test::refusal_of([&] { other.watch.archive(cut); }).find("too few numbers"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter::dynamics
