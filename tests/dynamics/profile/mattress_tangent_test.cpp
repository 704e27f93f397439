// SPDX-License-Identifier: GPL-3.0-or-later
// The tangent of the mattress against differences of its force.
#include <gtest/gtest.h>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace testing;

/// Rotations and moments count with an arm of a pin's distance.
const Vector3d kScale(1.0, 1.0, 1.0 / 4e-3);

double difference(const Matrix3d& found, const Matrix3d& expected) {
  const Matrix3d scale = kScale.asDiagonal();
  return (scale * (found - expected) * scale).norm() / (scale * expected * scale).norm();
}

/// Largest difference of both tangents from central differences.
double tangent_error(const MattressContact& contact, const Vector3d& q, const Vector3d& v) {
  const MattressForce at = force_at(contact, q, v);
  Matrix3d by_pose, by_rate;
  // Steps of 1e-4 of the depth and of the slip speed: their squares are what central differences
  // lose.
  const double shift = 1e-9, change = 2e-6;
  for (int i = 0; i < 3; ++i) {
    const Vector3d dq = shift * kScale[i] * Vector3d::Unit(i),
                   dv = change * kScale[i] * Vector3d::Unit(i);
    by_pose.col(i) =
        (force_at(contact, q + dq, v).wrench - force_at(contact, q - dq, v).wrench) / (2.0 * dq[i]);
    by_rate.col(i) =
        (force_at(contact, q, v + dv).wrench - force_at(contact, q, v - dv).wrench) / (2.0 * dv[i]);
  }
  const double pose_error = difference(at.by_pose, by_pose);
  return by_rate.norm() == 0.0 ? pose_error : std::max(pose_error, difference(at.by_rate, by_rate));
}

double largest_error(const MattressContact& contact, double from, double to, double speed) {
  TouchingPoses poses(contact, 2e-5, 3);
  double error = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d q = poses.at(poses.uniform(from, to), poses.uniform(-0.5, 0.5));
    error = std::max(error, tangent_error(contact, q, poses.rate(speed, speed / 4e-3)));
  }
  return error;
}

TEST(MattressTangent, OfABushInEveryPositionOfATooth) {
  const Profile profile = crank_sprocket();
  const MattressContact contact(profile, bush(), bush_law());
  const auto& cells = profile.cells();
  for (const double speed : {0.01, 0.5}) {
    EXPECT_LT(largest_error(contact, cells[1].start, cells[4].start, speed), 1e-5);
    const double length = profile.part_length();
    EXPECT_LT(largest_error(contact, cells[4].start - 2e-4, length + 1e-3, speed), 1e-5);
  }
}

TEST(MattressTangent, OfABushWhoseContactEndsAtTheBorderOfSeatAndFlank) {
  const Profile profile = crank_sprocket();
  const double border = profile.cells()[3].start;
  const MattressContact contact(profile, bush(), bush_law());
  const MattressContact smooth(profile, bush(), elastic(bush_law()));
  EXPECT_LT(largest_error(smooth, border - 2e-4, border + 2e-4, 0.5), 1e-5);
  // As an end of the contact passes a border, the tangent jumps by the error of Gauss' rule, which
  // is larger where the slip changes its sign between sections.
  EXPECT_LT(largest_error(contact, border - 2e-4, border + 2e-4, 0.5), 1e-3);
}

TEST(MattressTangent, OfAPlateOnAGuide) {
  const Profile profile = guide();
  const MattressContact contact(profile, plate(), plate_law());
  TouchingPoses poses(contact, 2e-5, 5);
  for (int i = 0; i < 200; ++i) {
    const double s = poses.uniform(0.0, profile.length());
    const ProfilePoint at = profile.at(s);
    const double slope = std::atan2(-at.tangent.y(), -at.tangent.x());
    const Vector3d q = poses.at(s, slope + poses.uniform(-0.01, 0.01));
    EXPECT_LT(tangent_error(contact, q, poses.rate(0.1, 20.0)), 1e-5);
  }
}

TEST(MattressTangent, OfAPlateAndABushOnASpline) {
  const Profile profile({ellipse(0.03, 0.02, 60)}, {.closed = true});
  const MattressContact round(profile, bush(), bush_law()), straight(profile, plate(), plate_law());
  EXPECT_LT(largest_error(round, 0.0, profile.length(), 0.1), 1e-5);
  EXPECT_LT(largest_error(straight, 0.0, profile.length(), 0.1), 1e-5);
}

TEST(MattressTangent, WhereTheContactWouldPull) {
  const Profile profile = flat();
  MattressLaw law = bush_law();
  law.damping = 2.0;
  const MattressContact contact(profile, bush(), law);
  for (const double speed : {0.44, 0.46, 0.5, 0.53})
    EXPECT_LT(tangent_error(contact, {0.0, 2.49e-3, 0.02}, {0.01, speed, 0.1}), 1e-5) << speed;
  const MattressForce free = force_at(contact, {0.0, 2.49e-3, 0.02}, {0.01, 1.0, 0.1});
  EXPECT_GT(free.depth, 0.0);
  EXPECT_EQ(free.wrench.norm() + free.by_pose.norm() + free.by_rate.norm(), 0.0);
}

TEST(MattressTangent, IsSymmetricWithoutDampingAndFriction) {
  const Profile profile = crank_sprocket();
  const MattressContact contact(profile, bush(), elastic(bush_law()));
  TouchingPoses poses(contact, 2e-5, 9);
  for (int i = 0; i < 100; ++i) {
    const MattressForce force = force_at(
        contact, poses.at(poses.uniform(0.0, profile.part_length()), poses.uniform(-3.0, 3.0)));
    // The sum is the gradient of the energy up to the error of Gauss' rule.
    EXPECT_LT(difference(force.by_pose, force.by_pose.transpose()), 1e-7);
    EXPECT_EQ(force.by_rate.norm(), 0.0);
  }
}

}  // namespace
}  // namespace clatter::dynamics
