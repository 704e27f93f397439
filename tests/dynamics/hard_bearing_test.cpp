// SPDX-License-Identifier: GPL-3.0-or-later
// Bearings whose journal touches: timing drive, hard case 8.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dynamics/bearing/bearing_film.hpp"
#include "dynamics/element/element.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

TEST(HardTD8_ZeroClearance, AJournalThatTouchesItsBearingIsRefusedAndNoForceIsNotANumber) {
  const BearingSize size{24e-3, 16e-3, 2e-3, 10e-3};
  const double c = size.radial_clearance();
  for (const BearingModel model : {BearingModel::kButenschoen, BearingModel::kMoes}) {
    const BearingFilm film(size, model);
    double before = 0.0;
    // As e -> 1 the force grows without bound, but is finite until the step is refused.
    for (const double left : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
      const FilmForce found = film.force({{c * (1.0 - left), 0.0}, {c * 10.0, 0.0}, 178.0});
      EXPECT_TRUE(found.value.allFinite() && found.by_motion.allFinite()) << left;
      EXPECT_GT(-found.value(0), 0.0);
      if (before > 0.0)
        test::expect_at_least("growth of the force toward contact", -found.value(0) / before, 2.0);
      before = -found.value(0);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double e : {1.0, 1.2, 1e9, nan}) {
      try {
        film.force({{c * e, 0.0}, {0.0, 0.0}, 178.0});
        FAIL() << e << " was accepted";
      } catch (const StepRefused& refused) {
        EXPECT_EQ(refused.kind(), "the journal touches the bearing");
        EXPECT_NE(refused.detail().find("relative eccentricity"), std::string::npos);
      }
    }
    // Nothing moves: no force; and no direction is special at the centre.
    const FilmForce still = film.force({{0.0, 0.0}, {0.0, 0.0}, 0.0});
    EXPECT_EQ(still.value.norm(), 0.0);
    EXPECT_TRUE(still.by_motion.allFinite());
  }
}

}  // namespace
}  // namespace clatter::dynamics
