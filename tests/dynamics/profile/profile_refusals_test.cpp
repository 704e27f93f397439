// SPDX-License-Identifier: GPL-3.0-or-later
// What profiles, gaps and contacts refuse, and what they say.
#include <gtest/gtest.h>

#include <limits>

#include "tests/dynamics/profile/profile_cases.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using test::expect_parts;
using test::refusal_of;
using testing::kPi;

std::string refusal(const std::vector<Segment>& segments, const ProfileOptions& options = {}) {
  return refusal_of([&] { Profile(segments, options); });
}

TEST(ProfileRefusals, GapsBetweenSegments) {
  const LineSegment first{{0.0, 0.0}, {1.0, 0.0}};
  expect_parts(refusal({first, LineSegment{{1.0, 2e-9}, {2.0, 2e-9}}}),
               {"segment 2 begins 2e-09 m from the end of segment 1", "at most 1e-09 m"});
  EXPECT_EQ(refusal({first, LineSegment{{1.0, 5e-10}, {2.0, 5e-10}}}), "accepted");
  expect_parts(refusal({first}, {.closed = true}),
               {"segment 1 begins 1 m from the end of segment 1"});
}

TEST(ProfileRefusals, Kinks) {
  const LineSegment first{{0.0, 0.0}, {1.0, 0.0}}, second{{1.0, 0.0}, {2.0, 0.1}};
  expect_parts(refusal({first, second}),
               {"kink of 5.71 deg between segments 1 and 2", "0.0573 deg"});
  EXPECT_EQ(refusal({first, second}, {.largest_kink = 0.11}), "accepted");
  expect_parts(refusal({first, LineSegment{{1.0, 0.0}, {0.0, 0.0}}}, {.largest_kink = 3.1}),
               {"kink of 180 deg"});
}

TEST(ProfileRefusals, PartsThatDoNotContinueEachOther) {
  const ArcSegment arc{{0.0, 0.0}, 0.1, 0.0, 2.0 * kPi / 5.0};
  EXPECT_EQ(refusal({arc}, {.repeats = 5}), "accepted");
  expect_parts(refusal({arc}, {.repeats = 6}), {"segment 1 begins"});
  expect_parts(refusal({arc}, {.repeats = 0}), {"0 parts, expected at least 1"});
}

TEST(ProfileRefusals, SegmentsWithoutLengthOrTangent) {
  expect_parts(refusal({}), {"no segments"});
  expect_parts(refusal({LineSegment{{0.0, 0.0}, {0.0, 0.0}}}), {"segment 1", "a line of 0 m"});
  expect_parts(refusal({ArcSegment{{0.0, 0.0}, -1.0, 0.0, 1.0}}), {"radius -1 m"});
  expect_parts(refusal({ArcSegment{{0.0, 0.0}, 1.0, 0.0, 7.0}}),
               {"turns by 7 rad", "one revolution"});
  const Vector2d o(0.0, 0.0), x(1.0, 0.0);
  expect_parts(refusal({BezierSegment{{o, o, x, x}}}), {"segment 1", "derivative vanishes"});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_parts(refusal({LineSegment{o, {nan, 0.0}}}), {"segment 1"});
  expect_parts(refusal({BezierSegment{{o, {0.3, nan}, {0.6, 0.0}, x}}}), {"not finite"});
}

TEST(ProfileRefusals, PointsThatMakeNoSpline) {
  const Vector2d a(0.0, 0.0), b(1.0, 0.0), c(1.0, 1.0), d(0.0, 1.0);
  expect_parts(refusal({PointsSegment{{a, b, c}, false, {}, {}}}),
               {"open curve through 3", "at least 4"});
  expect_parts(refusal({PointsSegment{{a, b}, true, {}, {}}}),
               {"closed curve through 2", "at least 3"});
  expect_parts(refusal({PointsSegment{{a, b, b, c}, false, {}, {}}}),
               {"points 2 and 3 are 0 m apart"});
  expect_parts(refusal({PointsSegment{{a, b, c, a}, true, {}, {}}}),
               {"points 4 and 1 are 0 m apart"});
  expect_parts(refusal({PointsSegment{{a, b, c, d}, true, {}, {}}, LineSegment{a, b}}),
               {"segment 1", "closed curve among other segments"});
}

TEST(ProfileRefusals, GapsThatAreNoTeeth) {
  expect_parts(refusal_of([] { iso606_gap(8e-3, 9e-3, 20); }),
               {"pitch 8 mm, rollers of 9 mm, 20 teeth"});
  expect_parts(refusal_of([] { iso606_gap(8e-3, 5e-3, 4); }), {"4 teeth", "at least 5"});
  ToothGap gap = iso606_gap(8e-3, 5e-3, 20);
  gap.tip_diameter = 57e-3;
  const std::string pointed = refusal_of([&] { sprocket(gap); });
  expect_parts(pointed, {"pointed at a diameter of", "found 57 mm"});
  gap.tip_diameter = 48e-3;
  expect_parts(refusal_of([&] { sprocket(gap); }), {"do not reach the tip diameter of 48 mm"});
  gap.seat_half_angle = 2.0;
  expect_parts(refusal_of([&] { sprocket(gap); }), {"half angles below 90 deg"});
}

TEST(ProfileRefusals, TeethAreAcceptedJustBelowThePointedDiameter) {
  ToothGap gap = iso606_gap(8e-3, 5e-3, 20);
  gap.tip_diameter = 1.0;
  const std::string far = refusal_of([&] { sprocket(gap); });
  expect_parts(far, {"do not reach"});
  gap.tip_diameter = 57e-3;
  const std::string pointed = refusal_of([&] { sprocket(gap); });
  const double diameter = 1e-3 * std::stod(pointed.substr(pointed.find("diameter of ") + 12));
  gap.tip_diameter = diameter - 1e-6;
  EXPECT_EQ(refusal_of([&] { sprocket(gap); }), "accepted");
  gap.tip_diameter = diameter + 1e-6;
  expect_parts(refusal_of([&] { sprocket(gap); }), {"pointed"});
}

TEST(ProfileRefusals, ContactsOutsideTheirRange) {
  const Profile profile = testing::flat();
  const auto law = [&](auto change) {
    MattressLaw changed = testing::bush_law();
    change(changed);
    return refusal_of([&] { MattressContact(profile, testing::bush(), changed); });
  };
  expect_parts(law([](MattressLaw& l) { l.stiffness = 0.0; }),
               {"mattress: stiffness 0, expected above 0"});
  expect_parts(law([](MattressLaw& l) { l.width = -1.0; }), {"width -1"});
  expect_parts(law([](MattressLaw& l) { l.damping = -1.0; }), {"damping -1"});
  expect_parts(law([](MattressLaw& l) { l.friction = -0.1; }), {"friction -0.1"});
  expect_parts(law([](MattressLaw& l) { l.slip_speed = 0.0; }), {"slip speed 0"});
  expect_parts(law([](MattressLaw& l) { l.sections = 9; }), {"sections 9, expected 2 to 8"});
  EXPECT_EQ(law([](MattressLaw&) {}), "accepted");
  expect_parts(refusal_of([&] {
                 MattressContact(profile, {1.0, 0.0, 1.0}, testing::bush_law());
               }),
               {"link outline", "from <= to"});
  expect_parts(refusal_of([] { small_depth_stiffness(testing::bush_law(), 2.5e-3, -400.0); }),
               {"circle of radius 0.0025 m in a hollow of radius 0.0025 m"});
}

}  // namespace
}  // namespace clatter::dynamics
