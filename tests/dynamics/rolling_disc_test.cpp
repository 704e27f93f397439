// SPDX-License-Identifier: GPL-3.0-or-later
// A disc that rolls on a plane.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "dynamics/element/disc_contact.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::arbitrary;
using testing::started;

constexpr double kDiscMass = 1.5, kRadius = 0.2, kGravity = 9.81;
const Vector3d kMoments(kDiscMass* kRadius* kRadius / 4.0, kDiscMass* kRadius* kRadius / 4.0,
                        kDiscMass* kRadius* kRadius / 2.0);
const DiscPlane kPlane{Vector3d::Zero(), Vector3d::UnitZ(), 1e7, 1e9, 1.0, 1e-5};

Vector3d lowest(const Vector3d& axis) {
  return kRadius * (axis.z() * axis - Vector3d::UnitZ()).normalized();
}

/// Where a disc is that rolls: attitude, angular velocity in space, centre.
struct Roll {
  Matrix3d A;
  Vector3d spin, centre;
  Vector3d velocity() const { return -spin.cross(lowest(A.col(2))); }
};

/// The equations of a disc that rolls without slip (Routh 1905, art. 241), by the angular momentum
/// about the point of contact: w' from J w' + w x J w = d x m (r'' + g).
Vector3d spin_rate(const Roll& at) {
  const Vector3d axis = at.A.col(2), axis_rate = at.spin.cross(axis), z = Vector3d::UnitZ();
  const Vector3d slope = axis.z() * axis - z, d = lowest(axis), u = d / kRadius;
  const Vector3d slope_rate = axis_rate.z() * axis + axis.z() * axis_rate;
  const Vector3d d_rate = kRadius / slope.norm() * (slope_rate - u * u.dot(slope_rate));
  const Matrix3d J = at.A * kMoments.asDiagonal() * at.A.transpose();
  const Matrix3d about_contact =
      J + kDiscMass * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  return about_contact.inverse() *
         (kDiscMass * d.cross(kGravity * z - at.spin.cross(d_rate)) - at.spin.cross(J * at.spin));
}

/// Those equations by the classical Runge-Kutta method; the columns of A are free vectors.
Roll rolled(Roll at, double end, int steps) {
  const double h = end / steps;
  const auto moved = [](const Roll& from, const Roll& rate, double time) {
    return Roll{from.A + time * rate.A, from.spin + time * rate.spin,
                from.centre + time * rate.centre};
  };
  const auto rate_of = [](const Roll& one) {
    return Roll{skew(one.spin) * one.A, spin_rate(one), one.velocity()};
  };
  for (int k = 0; k < steps; ++k) {
    const Roll a = rate_of(at), b = rate_of(moved(at, a, h / 2)), c = rate_of(moved(at, b, h / 2)),
               d = rate_of(moved(at, c, h));
    for (const auto& [rate, weight] :
         {std::pair{&a, 1.0}, std::pair{&b, 2.0}, std::pair{&c, 2.0}, std::pair{&d, 1.0}})
      at = moved(at, *rate, weight * h / 6.0);
  }
  return at;
}

/// A disc on its plane, from a rolling state.
struct Disc {
  System system;
  SpatialBody body;

  explicit Disc(const Roll& roll)
      : body(
            add_spatial_body(system, make_spatial_body("disc", kDiscMass, kMoments, start(roll)))) {
    system.add_element(std::make_unique<DiscContact>("edge", body.coordinates, body.frame,
                                                     Vector3d::UnitZ(), kRadius, kPlane));
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(kSpatial);
    weight(2) = std::sqrt(kDiscMass);
    system.add_load({"gravity", 0, weight, [](double) { return -kGravity; }});
  }
  static SpatialMotion start(const Roll& roll) {
    SpatialMotion motion;
    motion.rotation = Eigen::Quaterniond(roll.A);
    motion.spin = roll.A.transpose() * roll.spin;
    motion.centre = roll.centre;
    // As deep as its weight presses it in.
    motion.centre.z() -= kDiscMass * kGravity / kPlane.stiffness;
    motion.velocity = roll.velocity();
    return motion;
  }
  Roll at(const StageState& state) const {
    const Matrix3d A = rotation_matrix(body.quaternion(state));
    return {A, A * body.spin(state), gather(state.y, body.coordinates).head<3>()};
  }
};

StepOptions steps(double tolerance) {
  StepOptions options;
  options.largest = 1e-2;
  options.accuracy = {tolerance, kRadius, 1.0, kRadius};
  return options;
}

/// Axis at the angle `tilt` from the vertical, above the contact at the origin.
Roll leaning(double tilt) {
  Roll roll;
  roll.A = Eigen::AngleAxisd(tilt, Vector3d::UnitY()).toRotationMatrix();
  roll.centre = -lowest(roll.A.col(2));
  return roll;
}

TEST(RollingDisc, TangentIsTheDifferenceQuotientOfTheForce) {
  const auto frame = std::make_shared<SpatialFrame>(kMoments.asDiagonal().toDenseMatrix(),
                                                    arbitrary(4, 2).normalized(), arbitrary(3, 3));
  DiscPlane soft{Vector3d(0.0, 0.0, 2.0), Vector3d::UnitZ(), 3.0, 0.7, 0.6, 0.5};
  DiscContact contact("edge", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, frame, Vector3d::UnitZ(), kRadius,
                      soft);
  Eigen::VectorXd y = arbitrary(10, 4);
  y.tail<3>() *= 0.01;  // angular momentum: some radians per second
  EXPECT_LT(testing::tangent_error(contact, y, arbitrary(10, 5)), 1e-7);
}

TEST(RollingDisc, SteadyPrecessionKeepsItsTiltAndItsCircle) {
  // Precession P about the vertical, tilt b of the axis: the balance of moments about the centre,
  //   P sin b (C w - A P cos b) = - m R^2 P w sin b - m g R cos b,
  // gives the spin w about the axis; the centre circles at the distance R w / P.
  const double tilt = 1.2, P = 4.0, A = kMoments(0), C = kMoments(2);
  const double w = (A * P * P * std::sin(tilt) - kDiscMass * kGravity * kRadius) * std::cos(tilt) /
                   (P * std::sin(tilt) * (C + kDiscMass * kRadius * kRadius));
  Roll start = leaning(tilt);
  start.spin = w * start.A.col(2) - P * std::sin(tilt) * lowest(start.A.col(2)) / kRadius;
  start.centre.x() = -kRadius * w / P;
  start.centre.y() = 0.0;
  Disc disc(start);
  const auto method = started(disc.system, steps(1e-5));
  double tilting = 0.0, leaving = 0.0;
  const double end = 3.0 * 2.0 * std::numbers::pi / P;
  while (method->state().time < end) {
    method->step(end);
    const Roll at = disc.at(method->state());
    tilting = std::max(tilting, std::abs(std::acos(at.A(2, 2)) - tilt));
    leaving = std::max(leaving, std::abs(at.centre.head<2>().norm() - std::abs(kRadius * w / P)));
  }
  const double back = (disc.at(method->state()).centre.head<2>() - start.centre.head<2>()).norm();
  std::printf("three circles: tilt %.1e rad, radius %.1e m of %.3f, end %.1e m, %lld steps\n",
              tilting, leaving, std::abs(kRadius * w / P), back, method->statistics().accepted);
  EXPECT_LT(tilting, 1e-3);
  EXPECT_LT(leaving, 1e-3);
  EXPECT_LT(back, 1e-2);
}

TEST(RollingDisc, AWobblingDiscFollowsTheEquationsOfRollingWithoutSlip) {
  Roll start = leaning(1.3);
  start.spin = 8.0 * start.A.col(2) + 0.8 * Vector3d::UnitX() + 0.5 * Vector3d::UnitZ();
  const double end = 1.5;
  const Roll expected = rolled(start, end, 20000);
  double before = 1.0;
  for (const double tolerance : {1e-4, 1e-6}) {
    Disc disc(start);
    EnergyBalance energy(disc.system);
    const auto method = make_integrator(disc.system, steps(tolerance));
    method->set_observer(&energy);
    method->start(-1e-7, disc.system.eta_start(), disc.system.v_start());
    while (method->state().time < end) method->step(end);
    const Roll found = disc.at(method->state());
    const double error = (found.centre - expected.centre).norm(),
                 turn = (found.A - expected.A).norm();
    std::printf("tolerance %.0e: centre %.1e m after %.2f m, attitude %.1e, residue %.1e, %lld\n",
                tolerance, error, (expected.centre - start.centre).norm(), turn, energy.residue(),
                method->statistics().accepted);
    EXPECT_LT(error, 0.5 * before);
    before = error;
  }
  EXPECT_LT(before, 1e-3);
}

}  // namespace
}  // namespace clatter::dynamics
