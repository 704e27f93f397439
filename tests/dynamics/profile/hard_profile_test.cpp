// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases of profiles and their contacts.
#include <gtest/gtest.h>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace testing;

/// A contact that is shifted by so much [m] has this force, to first order.
double shift_of(const MattressForce& a, const MattressForce& b) {
  return (a.wrench - b.wrench).head<2>().norm() / a.by_pose.topLeftCorner<2, 2>().norm();
}

TEST(HardTD14_AnglesModuloAGap, AllGapsGiveTheSameContact) {
  for (const int teeth : {20, 40}) {
    const Profile profile = sprocket(iso606_gap(kPitch, kBush, teeth));
    const MattressContact contact(profile, bush(), bush_law());
    TouchingPoses poses(contact, 1e-5, 41);
    for (int i = 0; i < 20; ++i) {
      const Vector3d q = poses.at(poses.uniform(0.0, profile.part_length()), 0.3),
                     v = poses.rate(0.1, 10.0);
      const MattressForce first = force_at(contact, q, v);
      for (int part = 1; part < teeth; ++part) {
        const Eigen::Rotation2Dd turn(2.0 * kPi * part / teeth);
        Vector3d at, rate;
        at << turn * Vector2d(q.head<2>()), q.z() + turn.angle();
        rate << turn * Vector2d(v.head<2>()), v.z();
        MattressForce found = force_at(contact, at, rate);
        found.wrench.head<2>() = turn.inverse() * Vector2d(found.wrench.head<2>());
        EXPECT_LT(shift_of(first, found), 1e-15);
        EXPECT_NEAR(found.depth, first.depth, 1e-15);
      }
    }
  }
}

TEST(HardProfile, ABushAsLargeAsItsSeatAndLargerIsCarried) {
  ToothGap gap = iso606_gap(kPitch, kBush, 20);
  for (const double radius : {2.4999e-3, 2.5e-3, 2.5001e-3, 2.49e-3}) {
    gap.seat_radius = radius;
    const Profile profile = sprocket(gap);
    const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), elastic(bush_law()));
    double before = 0.0;
    for (double depth = 0.0; depth < 5e-5; depth += 1e-7) {
      // From where it touches the bottom.
      const double x = 0.5 * gap.pitch_diameter - radius + 2.5e-3 - depth;
      const MattressForce force = force_at(contact, {x, 0.0, 0.0});
      ASSERT_TRUE(force.wrench.allFinite() && force.by_pose.allFinite());
      EXPECT_GE(force.wrench.x(), before);
      EXPECT_NEAR(force.wrench.y(), 0.0, 1e-6 * (1.0 + force.wrench.x()));  // symmetric
      before = force.wrench.x();
    }
    EXPECT_GT(before, 0.0);
  }
}

TEST(HardProfile, ConcentricCirclesGiveNoForceAndNoNaN) {
  const Profile hole({ArcSegment{{0.0, 0.0}, 2.5e-3, 0.0, 2.0 * kPi}},
                     {.solid = ProfileOptions::Solid::kRight, .closed = true});
  for (const double radius : {2.4e-3, 2.5e-3, 2.51e-3}) {
    const MattressContact contact(hole, LinkOutline::circle(0.0, radius), bush_law());
    const MattressForce force = force_at(contact, Vector3d::Zero());
    EXPECT_TRUE(force.by_pose.allFinite());
    EXPECT_NEAR(force.wrench.norm(), 0.0, 1e-6);
  }
}

TEST(HardProfile, GrazingContactsAreSmoothDownToRounding) {
  const Profile profile = crank_sprocket();
  const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), elastic(bush_law()));
  const ProfilePoint at = profile.at(profile.cells()[3].start + 1e-3);
  const double stiffness = small_depth_stiffness(contact.law(), 2.5e-3, at.curvature);
  for (double depth = 1e-6; depth > 1e-18; depth *= 0.3) {
    const Vector2d centre = at.position + (2.5e-3 - depth) * at.normal;
    const MattressForce force = force_at(contact, {centre.x(), centre.y(), 0.0});
    ASSERT_TRUE(force.wrench.allFinite() && force.by_pose.allFinite());
    const double expected = stiffness * std::pow(depth, 1.5);
    // Positions are rounded to some 1e-17 m.
    const double rounding = stiffness * std::pow(depth + 2e-17, 1.5) - expected;
    EXPECT_NEAR(force.wrench.head<2>().norm(), expected, 1e-3 * expected + 2.0 * rounding);
  }
}

TEST(HardProfile, ABushOnTheEndOfAnOpenGuideIsCarried) {
  const Profile profile({LineSegment{{0.02, 0.0}, {0.0, 0.0}}});
  const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), bush_law());
  // It hits the end from the side, then from a little below.
  const MattressForce side = force_at(contact, {-2.49e-3, 1e-6, 0.0});
  EXPECT_LT(side.wrench.x(), 0.0);
  EXPECT_FALSE(side.too_deep);
  EXPECT_FALSE(force_at(contact, {-2.48e-3, -1e-4, 0.0}).too_deep);
}

}  // namespace
}  // namespace clatter::dynamics
