// SPDX-License-Identifier: GPL-3.0-or-later
// Finger followers: kinematics, profiles of cams, contact of the roller.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/valve/cam_profile.hpp"
#include "dynamics/valve/follower_geometry.hpp"
#include "dynamics/valve/roller_contact.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

CamLaw reference_law() { return CamLaw::polynomial(7.5e-3, 70.0 * kDegree); }

TEST(Follower, OracleKinematicsAndForcesOfTheReference) {
  struct Row {
    double angle, lift, slope, tilt, force;  // [deg], [mm], [mm/rad], [deg]
  };
  const FollowerGeometry geometry;
  EXPECT_NEAR(geometry.base_radius(), 15e-3, 1e-8);
  for (const Row& row : {Row{-30.0, 4.079933, 10.519332, 6.796569, 1.805690},
                         {0.0, 7.5, 0.0, 12.420305, 1.837493},
                         {30.0, 4.079933, -10.519332, 6.796569, 2.025116}}) {
    const double angle = row.angle * kDegree;
    const SplinePoint lift = reference_law().at(angle);
    const FollowerState at = follower_at(geometry, lift, angle, 1.0);
    EXPECT_NEAR(lift.value / kMilli, row.lift, 5e-7);
    EXPECT_NEAR(lift.first / kMilli, row.slope, 5e-7);
    EXPECT_NEAR(at.tilt / kDegree, row.tilt, 5e-7);
    EXPECT_NEAR(at.roller_force, row.force, 5e-7);
    // Virtual work: the moment of the roller's force about the cam is - F y'.
    const Vector2d arm = at.roller - geometry.cam;
    const double moment = -(arm.x() * at.normal.y() - arm.y() * at.normal.x()) * at.roller_force;
    EXPECT_NEAR(moment, -lift.first, 1e-12);
    std::printf("%5.0f deg: y %.6f mm, y' %.6f mm/rad, tilt %.6f deg, force %.6f, moment %.6f mm\n",
                row.angle, lift.value / kMilli, lift.first / kMilli, at.tilt / kDegree,
                at.roller_force, moment / kMilli);
  }
}

TEST(CamProfile, OracleTheSmallestRadiusOfTheReference) {
  for (const double turn : {1.0, -1.0}) {
    const CamProfile cam = CamProfile::of_law({}, reference_law(), turn);
    if (turn > 0.0) {
      EXPECT_NEAR(cam.smallest_radius() / kMilli, 8.68, 5e-3);
      std::printf("smallest radius %.5f mm\n", cam.smallest_radius() / kMilli);
    }
    EXPECT_TRUE(cam.is_convex());
  }
}

TEST(CamProfile, ItsFollowerMovesTheValveByTheLaw) {
  const FollowerGeometry geometry;
  const CamLaw law = reference_law();
  for (const double turn : {1.0, -1.0}) {
    const CamProfile cam = CamProfile::of_law(geometry, law, turn);
    double worst = 0.0;
    for (double angle = -178.1; angle < 180.0; angle += 7.3) {
      const double lift = cam.lift(geometry, angle * kDegree + 6.0 * std::numbers::pi);
      worst = std::max(worst, std::abs(lift - law.at(angle * kDegree).value));
      if (std::abs(std::abs(angle) - 70.0) > 3.0) {
        EXPECT_EQ(cam.rests(angle * kDegree, 0.0), std::abs(angle) > 70.0) << angle;
      }
    }
    // Of the spline between points 0.13 to 0.3 mm apart, where the law's third derivative jumps.
    EXPECT_LT(worst, 1e-9);
    std::printf("lift off its law by %.2g nm at most\n", 1e9 * worst);
  }
}

TEST(CamProfile, AGivenRadiusIsAProfile) {
  // The polar radius of the reference's own cam gives the same lift.
  const FollowerGeometry geometry;
  const CamProfile first = CamProfile::of_law(geometry, reference_law(), 1.0);
  std::vector<double> angle, radius;
  double last = -1.0;
  const Profile& outline = first.profile();
  // From the polar angle 0 on, in the order of the arc length.
  double start = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const Vector2d p = outline.at(outline.length() * k / 20000).position;
    if (std::abs(std::atan2(p.y(), p.x())) < 4e-4 && p.x() > 0.0)
      start = outline.length() * k / 20000;
  }
  for (int k = 0; k < 1440; ++k) {
    const Vector2d p = outline.at(start + outline.length() * (k + 4) / 1448).position;
    double polar = std::atan2(p.y(), p.x());
    if (polar < 0.0) polar += 2.0 * std::numbers::pi;
    ASSERT_GT(polar, last);
    last = polar;
    angle.push_back(polar);
    radius.push_back(p.norm());
  }
  const CamProfile second = CamProfile::of_radius(
      geometry, PeriodicSpline(5, angle, radius, 2.0 * std::numbers::pi), 1.0);
  for (double at = -65.0; at <= 65.0; at += 10.0)
    EXPECT_NEAR(second.lift(geometry, at * kDegree), first.lift(geometry, at * kDegree), 1e-7);
  EXPECT_TRUE(second.rests(std::numbers::pi, 0.5));
  EXPECT_FALSE(second.rests(0.0, 0.0));
}

TEST(CamProfile, RefusesWhatCannotBeMade) {
  const FollowerGeometry geometry;
  test::expect_parts(
      test::refusal_of([&] { CamProfile::of_law(geometry, CamLaw::polynomial(7.5e-3, 0.6), 1.0); }),
      {"deg", "undercut", "8.5 mm"});
  test::expect_parts(
      test::refusal_of([&] { CamProfile::of_law(geometry, CamLaw::polynomial(45e-3, 2.0), 1.0); }),
      {"lift", "the follower reaches"});
}

/// The roller of a body in the plane on the cam of another one.
struct Rolling {
  System system;
  CamProfile profile = CamProfile::of_law({}, reference_law(), 1.0);
  std::vector<int> follower, cam;
  std::unique_ptr<RollerContact> contact;
  double start;  // angle of the cam

  explicit Rolling(double angle, double depth) : start(angle) {
    const FollowerGeometry geometry;
    const FollowerState at = follower_at(geometry, reference_law().at(angle), angle, 1.0);
    PlanarMotion body;
    body.centre = at.roller - depth * at.normal;
    follower = testing::add_planar(system, "follower", 0.04, 1e-5, body);
    body.centre = geometry.cam;
    body.angle = angle;
    cam = testing::add_planar(system, "cam", 1.0, 1e-3, body);
    const MattressLaw law{.stiffness = 1e13, .width = 8e-3, .damping = 1.0};
    contact = std::make_unique<RollerContact>(
        "cam", std::make_unique<PlanarPort>(follower, Vector2d::Zero()),
        CamCarrier{std::make_unique<PlanarPort>(cam, Vector2d::Zero()), {}, Vector3d::UnitX()},
        profile.shared(), geometry.roller_radius, law);
  }
  VectorXd y() const { return system.interface(system.eta_start()); }
};

TEST(RollerContact, TheTangentIsTheDerivativeOfTheForce) {
  for (const double angle : {-0.5, 0.0, 0.7, 2.5}) {
    Rolling rolling(angle, 10e-6);
    const VectorXd rate = 0.1 * testing::arbitrary(6, 5) + 50.0 * VectorXd::Unit(6, 5);
    EXPECT_LT(testing::tangent_error(*rolling.contact, rolling.y(), rate, 1e-9, 1e-5), 1e-4)
        << angle;
  }
}

TEST(RollerContact, ForceAndMomentBalance) {
  Rolling rolling(-0.4, 12e-6);
  Response response;
  const VectorXd y = rolling.y();
  rolling.contact->evaluate({0.0, 1e-5, 1, {}}, y, testing::arbitrary(6, 5), false, response);
  const VectorXd& f = response.force;
  const double size = f.head<2>().norm();
  EXPECT_GT(size, 100.0);
  EXPECT_LT((f.head<2>() + f.segment<2>(3)).norm(), 1e-12 * size);
  const double moment = f(2) + f(5) + y(0) * f(1) - y(1) * f(0) + y(3) * f(4) - y(4) * f(3);
  EXPECT_NEAR(moment, 0.0, 1e-14 * size);
  // The moment on the cam is that of the ideal force, to the depth of the contact.
  const SplinePoint lift = reference_law().at(-0.4);
  const FollowerState at = follower_at({}, lift, -0.4, 1.0);
  EXPECT_NEAR(f(5) / size, -lift.first / at.roller_force, 2e-5);
}

TEST(RollerContact, HardTD14_AfterHoursOfAngleTheContactIsTheSame) {
  const double turns = 1e5;  // an hour at 1700 rpm
  Rolling rolling(-0.4, 12e-6);
  Response first, later;
  VectorXd y = rolling.y();
  rolling.contact->evaluate({0.0, 1e-5, 1, {}}, y, VectorXd::Zero(6), true, first);
  y(5) += 2.0 * std::numbers::pi * turns;
  rolling.contact->evaluate({0.0, 1e-5, 1, {}}, y, VectorXd::Zero(6), false, later);
  // An angle of 6e5 rad has 1e-10 rad; the pitch curve is 0.01 m per rad there: 1e-12 m.
  const double stiffness = first.tangent.topLeftCorner<2, 2>().norm();
  EXPECT_LT((later.force - first.force).head<2>().norm() / stiffness, 1e-11);
}

}  // namespace
}  // namespace clatter::dynamics
