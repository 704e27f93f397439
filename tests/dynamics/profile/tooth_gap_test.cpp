// SPDX-License-Identifier: GPL-3.0-or-later
// Tooth gaps by ISO 606.
#include <gtest/gtest.h>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using testing::kPi;

struct GapOracle {
  int teeth;
  double pitch_diameter, seat_radius, flank_radius, half_angle_deg, tip_diameter;  // mm
  Vector2d seat_end, tip;                                                          // mm
};

class IsoGap : public ::testing::TestWithParam<GapOracle> {};
INSTANTIATE_TEST_SUITE_P(
    Oracles, IsoGap,
    ::testing::Values(
        GapOracle{
            20, 51.13963, 2.58399, 18.2, 62.75, 54.81963, {24.38667, 2.29722}, {27.11296, 4.02308}},
        GapOracle{40,
                  101.96396,
                  2.58399,
                  48.2,
                  63.875,
                  105.80396,
                  {49.84417, 2.32},
                  {52.75979, 3.87612}}));

TEST_P(IsoGap, OracleMeansOfTheTimingDrive) {
  const GapOracle& oracle = GetParam();
  const ToothGap gap = iso606_gap(testing::kPitch, testing::kBush, oracle.teeth);
  const double digits = 0.5e-5;  // of the reference [mm]
  EXPECT_NEAR(1e3 * gap.pitch_diameter, oracle.pitch_diameter, digits);
  EXPECT_NEAR(1e3 * gap.seat_radius, oracle.seat_radius, digits);
  EXPECT_NEAR(1e3 * gap.flank_radius, oracle.flank_radius, digits);
  EXPECT_NEAR(gap.seat_half_angle * 180.0 / kPi, oracle.half_angle_deg, 1e-10);
  EXPECT_NEAR(1e3 * gap.tip_diameter, oracle.tip_diameter, digits);
}

TEST_P(IsoGap, OracleCornersOfTheGapOnTheXAxis) {
  const GapOracle& oracle = GetParam();
  const ToothGap gap = iso606_gap(testing::kPitch, testing::kBush, oracle.teeth);
  const Profile profile = sprocket(gap);
  ASSERT_EQ(profile.cells().size(), 5u);  // tip, flank, seat, flank, tip
  const Vector2d seat_end = 1e3 * profile.at(profile.cells()[3].start).position;
  const Vector2d tip = 1e3 * profile.at(profile.cells()[4].start).position;
  const double digits = 0.5e-5;  // of the reference [mm]
  EXPECT_NEAR(seat_end.x(), oracle.seat_end.x(), digits);
  EXPECT_NEAR(seat_end.y(), oracle.seat_end.y(), digits);
  EXPECT_NEAR(tip.x(), oracle.tip.x(), digits);
  EXPECT_NEAR(tip.y(), oracle.tip.y(), digits);
}

TEST_P(IsoGap, IsSymmetricAndItsFlanksContinueTheSeatSmoothly) {
  const int teeth = GetParam().teeth;
  const Profile profile = sprocket(iso606_gap(testing::kPitch, testing::kBush, teeth));
  EXPECT_EQ(profile.repeats(), teeth);
  const double part = profile.part_length();
  for (const double s : {0.1, 0.2, 0.3, 0.4, 0.49}) {
    const ProfilePoint low = profile.at(s * part), high = profile.at((1.0 - s) * part);
    // Rounding of lengths of some 10 mm.
    EXPECT_NEAR(low.position.x(), high.position.x(), 1e-16);
    EXPECT_NEAR(low.position.y(), -high.position.y(), 1e-16);
    EXPECT_NEAR(low.curvature, high.curvature, 1e-9);
  }
  const double border = profile.cells()[3].start;
  const ProfilePoint seat = profile.at(border - 1e-12), flank = profile.at(border + 1e-12);
  EXPECT_LT((seat.normal - flank.normal).norm(), 1e-8);  // 2e-12 m over the seat's radius is 1e-9
  EXPECT_LT(seat.curvature, 0.0);
  EXPECT_GT(flank.curvature, 0.0);
}

TEST(ToothGap, FormsAreTheLimitsOfIso606) {
  const ToothGap narrow = iso606_gap(8e-3, 5e-3, 20, GapForm::kMinimum, GapForm::kMinimum);
  EXPECT_NEAR(narrow.seat_radius, 2.525e-3, 1e-15);
  EXPECT_NEAR(narrow.flank_radius, 13.2e-3, 1e-15);
  EXPECT_NEAR(narrow.seat_half_angle * 360.0 / kPi, 135.5, 1e-12);
  EXPECT_NEAR(narrow.tip_diameter - narrow.pitch_diameter, 2.36e-3, 1e-15);
  const ToothGap wide = iso606_gap(8e-3, 5e-3, 20, GapForm::kMaximum, GapForm::kMaximum);
  EXPECT_NEAR(wide.seat_radius, 2.525e-3 + 0.069e-3 * std::cbrt(5.0), 1e-15);
  EXPECT_NEAR(wide.flank_radius, 23.2e-3, 1e-15);
  EXPECT_NEAR(wide.seat_half_angle * 360.0 / kPi, 115.5, 1e-12);
  EXPECT_NEAR(wide.tip_diameter - wide.pitch_diameter, 5e-3, 1e-15);
}

}  // namespace
}  // namespace clatter::dynamics
