// SPDX-License-Identifier: GPL-3.0-or-later
// The planar flexible slider crank of Simeon (1996).
#include "tests/dynamics/flexible_crank.hpp"

#include <gtest/gtest.h>

namespace clatter::dynamics {
namespace {

using testing::crank_at;
using testing::expect_reference;

TEST(FlexibleSliderCrank, AgreesWithTheTestSet) {
  // Joints of 1e11 N/m give 4e-9 m under the rod's force: 5e-4 of the longitudinal displacements.
  expect_reference(crank_at(0.1, 1e11, 1e-2),
                   {{1e-7, 1e-7, 2e-4, 2e-4, 5e-3, 2e-3}, {1e-5, 1e-4, 3e-3}});
}

}  // namespace
}  // namespace clatter::dynamics
