// SPDX-License-Identifier: GPL-3.0-or-later
// The planar flexible slider crank of Simeon (1996) at a fine tolerance.
#include "tests/dynamics/flexible_crank.hpp"

#include <gtest/gtest.h>

namespace clatter::dynamics {
namespace {

using testing::crank_at;
using testing::expect_reference;

TEST(FlexibleSliderCrankLong, AgreesWithTheTestSetToTheDigitsOfTheTolerance) {
  expect_reference(crank_at(0.1, 1e12, 2e-4),
                   {{3e-8, 3e-8, 2e-6, 3e-5, 2e-4, 5e-4}, {1e-6, 5e-6, 2e-4}});
}

}  // namespace
}  // namespace clatter::dynamics
