// SPDX-License-Identifier: GPL-3.0-or-later
// The mattress against slow sums over dense polygons, and what it does at its limits.
#include <gtest/gtest.h>

#include <functional>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace testing;

/// A curve given by its own formula.
using Curve = std::function<Vector2d(double)>;

std::vector<Vector2d> polygon(const Curve& curve, double from, double to) {
  constexpr int kPoints = 200000;
  std::vector<Vector2d> points;
  for (int i = 0; i <= kPoints; ++i) points.push_back(curve(from + (to - from) * i / kPoints));
  return points;
}

/// Energy of the mattress, kappa b / 2 times the integral of the squared penetration, by the
/// midpoint rule on a polygon: uses nothing of the library.
double slow_energy(const std::vector<Vector2d>& points, const LinkOutline& outline,
                   const MattressLaw& law, const Vector3d& q) {
  const Vector2d axis(std::cos(q.z()), std::sin(q.z()));
  double sum = 0.0;
  for (size_t i = 1; i < points.size(); ++i) {
    const Vector2d arm = 0.5 * (points[i - 1] + points[i]) - q.head<2>();
    const double x = std::clamp(axis.dot(arm), outline.from, outline.to);
    const double depth = std::max(0.0, outline.radius - (arm - x * axis).norm());
    sum += (points[i] - points[i - 1]).norm() * depth * depth;
  }
  return 0.5 * law.stiffness * law.width * sum;
}

/// The force is minus the gradient of the energy: by central differences.
void expect_slow_force(const Curve& curve, double from, double to, const MattressContact& contact,
                       const Vector3d& q) {
  const std::vector<Vector2d> points = polygon(curve, from, to);
  const auto energy = [&](const Vector3d& at) {
    return slow_energy(points, contact.outline(), contact.law(), at);
  };
  const MattressForce found = force_at(contact, q);
  const double force = found.wrench.head<2>().norm();
  ASSERT_GT(force, 0.0);
  EXPECT_NEAR(found.stored, energy(q), 1e-6 * found.stored);
  for (int i = 0; i < 3; ++i) {
    const double unit = i < 2 ? 1.0 : 1.0 / 4e-3, h = 5e-9 * unit;
    const Vector3d shift = h * Vector3d::Unit(i);
    const double slow = -(energy(q + shift) - energy(q - shift)) / (2.0 * h);
    // Forces, and moments over the arm of a pin. Differences of 5 nm at depths of 1 um and more
    // lose (5e-3)^2/24.
    EXPECT_NEAR(found.wrench[i] * unit, slow * unit, 5e-6 * force) << i;
  }
}

Curve circle(const Vector2d& centre, double radius) {
  return [=](double angle) -> Vector2d {
    return centre + radius * Vector2d(std::cos(angle), std::sin(angle));
  };
}

TEST(Mattress, OfABushInTheSeatIsTheSlowSum) {
  const ToothGap gap = iso606_gap(kPitch, kBush, 20);
  const Profile profile = sprocket(gap);
  const MattressContact contact(profile, bush(), elastic(bush_law()));
  const Vector2d pitch_point(0.5 * gap.pitch_diameter, 0.0);
  TouchingPoses poses(contact, 2e-5, 12);
  const ProfileCell& seat = profile.cells()[2];
  for (const double share : {0.4, 0.5, 0.55}) {  // the contact ends inside the seat
    const Vector3d q = poses.at(seat.start + share * seat.length, 0.3);
    expect_slow_force(circle(pitch_point, gap.seat_radius), kPi - gap.seat_half_angle,
                      kPi + gap.seat_half_angle, contact, q);
  }
}

/// Eqs. (4) to (6) of the paper for a circle in a hollow circle: kappa b times the integral of
/// depth - z(x), z the sum of the heights along the one direction of contact.
double paper_force(const MattressLaw& law, double bush, double seat, double depth) {
  constexpr int kSteps = 400000;
  const double width = 0.8 * bush;  // the contact is narrower
  const auto height = [](double r, double x) { return r - std::sqrt(r * r - x * x); };
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = width * (2.0 * (i + 0.5) / kSteps - 1.0);
    sum += std::max(0.0, depth - height(bush, x) + height(seat, x)) * 2.0 * width / kSteps;
  }
  return law.stiffness * law.width * sum;
}

TEST(Mattress, OfABushInTheSeatIsThatOfThePaperLessWhatPushesSideways) {
  constexpr double kSeat = 2.58399e-3, kBushRadius = 2.5e-3;
  const Profile seat({ArcSegment{{0.0, 0.0}, kSeat, -0.5 * kPi + 0.7, -1.4}});  // bottom below
  const MattressContact contact(seat, LinkOutline::circle(0.0, kBushRadius), elastic(bush_law()));
  const double expected[3][3] = {
      {2e-6, 33.6607, 33.4880}, {5e-6, 131.0106, 129.3795}, {8e-6, 261.1956, 256.1401}};
  for (const auto& [depth, paper, here] : expected) {
    EXPECT_NEAR(paper_force(contact.law(), kBushRadius, kSeat, depth), paper, 1e-4);
    const double middle = -(kSeat - kBushRadius) - depth;
    EXPECT_NEAR(force_at(contact, {0.0, middle, 0.0}).wrench.y(), here, 1e-4);
  }
}

TEST(Mattress, OfAPlateOnAGuideIsTheSlowSum) {
  const Profile profile = guide();
  const MattressContact contact(profile, plate(), elastic(plate_law()));
  const Curve arc = circle({0.0, -0.28}, 0.28);
  for (const Vector3d& q : {Vector3d(0.0, 3.59e-3, 0.0), Vector3d(1e-3, 3.585e-3, 2e-3),
                            Vector3d(0.0, 3.6e-3, 0.03), Vector3d(1e-3, 3.59e-3, -0.015)})
    expect_slow_force(arc, 0.5 * kPi - 0.05, 0.5 * kPi + 0.05, contact, q);
}

TEST(Mattress, OfAPlateInAHollowIsTheSlowSum) {
  // A hollow guide carries the round ends: two zones.
  const Vector2d centre(0.0, 0.1);
  const Profile profile({ArcSegment{centre, 0.1, -0.5 * kPi + 0.2, -0.4}});
  const MattressContact contact(profile, plate(), elastic(plate_law()));
  for (const Vector3d& q :
       {Vector3d(0.0, 3.66e-3, 0.0), Vector3d(0.0, 3.66e-3, 2e-3), Vector3d(0.0, 3.57e-3, 0.0)})
    expect_slow_force(circle(centre, 0.1), -0.5 * kPi - 0.2, -0.5 * kPi + 0.2, contact, q);
}

TEST(Mattress, OfABezierCurveIsTheSlowSum) {
  const std::array<Vector2d, 4> b{
      Vector2d(0.01, 0.0), {0.005, 2e-3}, {-0.003, 1.5e-3}, {-0.01, 0.0}};
  const Curve curve = [&](double t) -> Vector2d {
    const double s = 1.0 - t;
    return s * s * s * b[0] + 3.0 * s * s * t * b[1] + 3.0 * s * t * t * b[2] + t * t * t * b[3];
  };
  const Profile profile({BezierSegment{b}});
  const MattressContact round(profile, bush(), elastic(bush_law()));
  const MattressContact straight(profile, plate(), elastic(plate_law()));
  for (const double s : {0.25, 0.45, 0.7}) {
    TouchingPoses on_round(round, 2e-5, 1), on_straight(straight, 2e-5, 2);
    expect_slow_force(curve, 0.0, 1.0, round, on_round.at(s * profile.length(), 0.2));
    expect_slow_force(curve, 0.0, 1.0, straight, on_straight.at(s * profile.length(), 0.05));
  }
}

TEST(Mattress, OfASplineIsTheSlowSumOfItsPoints) {
  const Profile profile({ellipse(0.03, 0.02, 60)}, {.closed = true});
  const Curve curve = [&](double s) { return profile.at(s).position; };
  const MattressContact contact(profile, bush(), elastic(bush_law()));
  TouchingPoses poses(contact, 2e-5, 12);
  for (const double share : {0.1, 0.3, 0.95}) {
    const double s = share * profile.length();
    expect_slow_force(curve, s - 2e-3, s + 2e-3, contact, poses.at(s, 0.3));
  }
}

TEST(Mattress, OfABushOnTheCornerOfATipIsTheSlowSum) {
  const ToothGap gap = iso606_gap(kPitch, kBush, 20);
  const Profile profile = sprocket(gap);
  const MattressContact contact(profile, bush(), elastic(bush_law()));
  const double corner = profile.cells()[4].start;
  // The polygon passes the corner and, on the tip, the border of two gaps.
  const Curve curve = [&](double s) { return profile.at(s).position; };
  TouchingPoses poses(contact, 2e-5, 12);
  for (const double off : {-2e-4, 0.0, 1e-4, 2.5e-4})
    expect_slow_force(curve, corner - 1e-3, corner + 1e-3, contact, poses.at(corner + off, -0.2));
}

TEST(Mattress, NeverPulls) {
  const Profile profile = flat();
  MattressLaw law = bush_law();
  law.friction = 0.0;
  const MattressContact contact(profile, bush(), law);
  double before = 0.0;
  for (double speed = 3.0; speed >= -1.0; speed -= 0.01) {
    const double force = force_at(contact, {4e-3, 2.49e-3, 0.0}, {0.0, speed, 0.0}).wrench.y();
    EXPECT_GE(force, before);  // it falls with the speed of separation, to nothing
    before = force;
  }
  EXPECT_EQ(force_at(contact, {4e-3, 2.49e-3, 0.0}, {0.0, 2.3, 0.0}).wrench.y(), 0.0);
}

TEST(Mattress, FrictionOpposesTheSlipOfSpinningBushes) {
  const Profile profile = flat();
  MattressLaw law = bush_law();
  law.damping = 0.0;
  const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), law);
  const double depth = 1e-6, arm = 2.5e-3 - depth;
  const Vector3d q(0.0, arm, 0.0);
  const double normal = force_at(contact, q).wrench.y();
  const auto friction = [&](double vx, double spin) {
    return force_at(contact, q, {vx, 0.0, spin}).wrench;
  };
  EXPECT_NEAR(friction(0.1, 0.0).x(), -law.friction * normal, 1e-4 * normal);
  EXPECT_NEAR(friction(0.0, 40.0).x(), -law.friction * normal,
              1e-4 * normal);  // its lowest point moves to +x
  EXPECT_NEAR(friction(0.0, 40.0).z(), -law.friction * normal * arm, 1e-4 * normal * arm);
  EXPECT_NEAR(friction(-0.1, 0.1 / arm).x(), 0.0, 1e-3 * normal);  // it rolls
  EXPECT_NEAR(friction(0.01, 0.0).x(), -law.friction * normal * 0.5 * (1.5 - 0.125), 1e-3 * normal);
  EXPECT_GT(force_at(contact, q, {0.1, 0.0, 0.0}).lost, 0.0);
}

TEST(Mattress, PowerOfTheForceIsEnergyStoredAndLost) {
  const Profile profile = crank_sprocket();
  const MattressContact contact(profile, bush(), bush_law());
  TouchingPoses poses(contact, 2e-5, 6);
  for (int i = 0; i < 100; ++i) {
    const Vector3d q =
        poses.at(poses.uniform(0.0, profile.part_length()), poses.uniform(-3.0, 3.0));
    const Vector3d v = poses.rate(0.5, 100.0);
    const MattressForce at = force_at(contact, q, v);
    const double h = 1e-9;
    const double stored =
        (force_at(contact, q + h * v).stored - force_at(contact, q - h * v).stored) / (2.0 * h);
    EXPECT_GE(at.lost, 0.0);
    EXPECT_NEAR(at.wrench.dot(v) + stored + at.lost, 0.0, 1e-6 * (std::abs(stored) + at.lost));
  }
}

TEST(Mattress, DepthIsThatOfTheDeepestSectionAndTheDistanceIsABound) {
  const Profile profile = crank_sprocket();
  const MattressContact contact(profile, bush(), bush_law());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> at(-0.032, 0.032), angle(-3.0, 3.0);
  int touching = 0, apart = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d q(at(random), at(random), angle(random));
    const Vector2d centre = q.head<2>() - 4e-3 * Vector2d(std::cos(q.z()), std::sin(q.z()));
    const ClosestPoint closest = profile.closest(centre);
    if (closest.distance < 1.5e-3) continue;
    const double depth = 2.5e-3 - closest.distance, found = force_at(contact, q).depth;
    (depth > 0.0 ? touching : apart) += 1;
    ASSERT_EQ(found > 0.0, depth > 0.0);
    if (depth > 0.0) {
      EXPECT_GT(found, 0.9 * depth);
      EXPECT_LE(found, depth + 1e-15);
    } else {
      EXPECT_GE(found, depth - 1e-15);
    }
  }
  EXPECT_GT(touching, 20);
  EXPECT_GT(apart, 200);
}

TEST(Mattress, SaysWhenALinkIsTooDeep) {
  const Profile profile = flat();
  const MattressContact contact(profile, bush(), bush_law());
  EXPECT_FALSE(force_at(contact, {4e-3, 1.3e-3, 0.0}).too_deep);
  EXPECT_TRUE(force_at(contact, {4e-3, 1.2e-3, 0.0}).too_deep);
  EXPECT_TRUE(force_at(contact, {4e-3, -2.4e-3, 0.0}).too_deep);  // on the inner side
}

}  // namespace
}  // namespace clatter::dynamics
