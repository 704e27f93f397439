// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetries and continuity of the mattress.
#include <gtest/gtest.h>

#include <functional>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace testing;

TEST(MattressInvariant, TheMirroredProfileMirrorsForceAndTangent) {
  const ToothGap gap = iso606_gap(kPitch, kBush, 20);
  std::vector<Segment> tooth = tooth_gap_segments(gap);
  tooth.pop_back();  // no longer symmetric, open
  PointsSegment points{
      {{0.03, 0.0}, {0.02, 3e-3}, {0.0, 4e-3}, {-0.02, 1e-3}}, false, Vector2d(-1.0, 0.2), {}};
  const std::vector<std::vector<Segment>> cases{tooth, {points}};
  for (const std::vector<Segment>& segments : cases) {
    const Profile profile(segments, {.largest_kink = 1.5}),
        image(mirrored(segments), {.largest_kink = 1.5});
    for (const LinkOutline& outline : {bush(), plate()}) {
      const MattressContact contact(profile, outline, bush_law()),
          other(image, outline, bush_law());
      TouchingPoses poses(contact, 2e-5, 21);
      for (int i = 0; i < 50; ++i) {
        const Vector3d q = poses.at(poses.uniform(0.0, profile.length()), poses.uniform(-0.5, 0.5));
        const Vector3d v = poses.rate(0.5, 100.0), flip(1.0, -1.0, -1.0);
        const MattressForce a = force_at(contact, q, v);
        const MattressForce b = force_at(other, flip.cwiseProduct(q), flip.cwiseProduct(v));
        // Rounding of points, 1e-17 m, over depths down to 1 um; the roots of cubics to 1e-10.
        EXPECT_LT((a.wrench - flip.cwiseProduct(b.wrench)).norm(), 1e-9 * a.wrench.norm());
        EXPECT_LT((a.by_pose - flip.asDiagonal() * b.by_pose * flip.asDiagonal()).norm(),
                  1e-7 * a.by_pose.norm());
        EXPECT_NEAR(a.lost, b.lost, 1e-9 * a.lost);
      }
    }
  }
}

TEST(MattressInvariant, TheForceTurnsWithTheProfile) {
  const Profile profile({ellipse(0.03, 0.02, 60)}, {.closed = true});
  const double angle = 0.7;
  const Eigen::Rotation2Dd turn(angle);
  PointsSegment turned = ellipse(0.03, 0.02, 60);
  for (Vector2d& point : turned.points) point = turn * point;
  const Profile other({turned}, {.closed = true});
  const MattressContact a(profile, plate(), plate_law()), b(other, plate(), plate_law());
  TouchingPoses poses(a, 2e-5, 22);
  for (int i = 0; i < 50; ++i) {
    const Vector3d q = poses.at(poses.uniform(0.0, profile.length()), poses.uniform(-0.5, 0.5));
    const Vector3d v = poses.rate(0.5, 100.0);
    Vector3d q2, v2;
    q2 << turn * Vector2d(q.head<2>()), q.z() + angle;
    v2 << turn * Vector2d(v.head<2>()), v.z();
    const Vector3d f = force_at(a, q, v).wrench, f2 = force_at(b, q2, v2).wrench;
    EXPECT_LT((turn * Vector2d(f.head<2>()) - f2.head<2>()).norm(), 1e-9 * f.norm());
    EXPECT_NEAR(f.z(), f2.z(), 1e-9 * f.norm() * 4e-3);
  }
}

TEST(MattressInvariant, MomentsBalance) {
  // The moment about the profile's origin of a central force of a round profile is that of
  // friction.
  const Profile wheel({ArcSegment{{0.0, 0.0}, 0.02, 0.0, 2.0 * kPi}}, {.closed = true});
  const MattressContact contact(wheel, bush(), elastic(bush_law()));
  TouchingPoses poses(contact, 2e-5, 23);
  for (int i = 0; i < 50; ++i) {
    const Vector3d q = poses.at(poses.uniform(0.0, wheel.length()), poses.uniform(-3.0, 3.0));
    const Vector3d f = force_at(contact, q).wrench;
    const double about_origin = f.z() + q.x() * f.y() - q.y() * f.x();
    EXPECT_NEAR(about_origin, 0.0, 1e-10 * f.norm() * 0.02);  // rounding of the depths
  }
}

TEST(MattressInvariant, HintsChangeNoForce) {
  const Profile profile = crank_sprocket();
  for (const LinkOutline& outline : {bush(), plate()}) {
    const MattressContact contact(profile, outline, bush_law());
    std::mt19937 random(31);
    std::normal_distribution<double> step(0.0, 1.0);
    ContactHint hint;
    Vector3d q(0.03, 0.0, 0.0);
    int touching = 0, apart = 0;
    for (int i = 0; i < 20000; ++i) {
      q += 2e-4 * Vector3d(step(random), step(random), 50.0 * step(random));
      if (q.head<2>().norm() < 0.028 || q.head<2>().norm() > 0.045)
        q.head<2>() *= 0.035 / q.head<2>().norm();
      MattressForce with;
      contact.evaluate(pose_at(q), rate_of({0.1, 0.2, 3.0}), true, hint, with);
      const MattressForce without = force_at(contact, q, {0.1, 0.2, 3.0});
      ASSERT_EQ(with.wrench, without.wrench);
      ASSERT_EQ(with.by_pose, without.by_pose);
      ASSERT_EQ(with.depth > 0.0, without.depth > 0.0);
      (with.depth > 0.0 ? touching : apart) += 1;
    }
    EXPECT_GT(touching, 100);
    EXPECT_GT(apart, 100);
  }
}

using Path = std::function<Vector3d(double)>;

/// Largest changes of force and tangent from one of so many steps along a path to the next.
struct LargestChange {
  double force = 0.0, tangent = 0.0;
};

LargestChange largest_change(const MattressContact& contact, const Path& path, int steps) {
  LargestChange result;
  MattressForce before = force_at(contact, path(0.0));
  for (int i = 1; i <= steps; ++i) {
    const MattressForce at = force_at(contact, path(static_cast<double>(i) / steps));
    result.force = std::max(result.force, (at.wrench - before.wrench).head<2>().norm());
    result.tangent = std::max(result.tangent, (at.by_pose - before.by_pose).norm());
    before = at;
  }
  return result;
}

/// A jump would stay as it is with smaller steps.
void expect_continuous(const MattressContact& contact, const Path& path) {
  const LargestChange coarse = largest_change(contact, path, 2000);
  const LargestChange fine = largest_change(contact, path, 32000);
  ASSERT_GT(coarse.force, 0.0);
  EXPECT_LT(fine.force, 0.1 * coarse.force);       // 1/16
  EXPECT_LT(fine.tangent, 0.35 * coarse.tangent);  // 1/4: it begins like the root of the depth
}

TEST(MattressInvariant, ForcesAreContinuousFromSeatToFlankToTipAndOverIt) {
  const Profile profile = crank_sprocket();
  const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), bush_law());
  const auto& cells = profile.cells();
  const auto along = [&](double from, double to) {
    return [&profile, from, to](double share) -> Vector3d {
      const ProfilePoint at = profile.at(from + share * (to - from));
      const Vector2d centre = at.position + (2.5e-3 - 1e-5) * at.normal;
      return {centre.x(), centre.y(), 0.0};
    };
  };
  expect_continuous(contact, along(cells[3].start - 5e-4, cells[3].start + 5e-4));
  expect_continuous(
      contact, along(cells[4].start + 1e-6, cells[4].start + 5e-4));  // over the border of gaps
  // Straight past the corner of the tip, where the normal jumps.
  const Vector2d corner = profile.at(cells[4].start).position;
  expect_continuous(contact, [&](double share) -> Vector3d {
    const Vector2d out = corner.normalized(), side(-out.y(), out.x());
    const Vector2d centre = corner + (2.5e-3 - 1e-5) * out + 2e-3 * (share - 0.5) * side;
    return {centre.x(), centre.y(), 0.0};
  });
}

TEST(MattressInvariant, ForcesAreContinuousWhileAPlateRollsFromItsBackToItsEndAndOffTheGuide) {
  const Profile profile = guide();
  const MattressContact contact(profile, plate(), plate_law());
  expect_continuous(contact, [](double share) {
    return Vector3d(0.0, 3.6e-3 - 5e-6 + 0.0 * share, 0.04 * (share - 0.5));
  });
  expect_continuous(contact, [](double share) -> Vector3d {
    // Along the arc, beyond its end.
    const double angle = 0.05 + 0.1 * share, r = 0.28 + 3.6e-3 - 1e-5;
    return {r * std::sin(angle), r * std::cos(angle) - 0.28, -angle};
  });
}

}  // namespace
}  // namespace clatter::dynamics
