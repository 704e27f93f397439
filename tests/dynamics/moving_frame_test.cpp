// SPDX-License-Identifier: GPL-3.0-or-later
// Eq. (9) in a prescribed frame: spinning elastic bodies.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "dynamics/element/moving_frame.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;

/// A point mass on springs in a frame: its displacement (x, y, z) in the frame, from `place`.
struct MassOnSprings {
  double mass = 2.0;
  Vector3d place{0.3, 0.0, 0.0};     // [m]
  Vector3d omega{50.0, 70.0, 90.0};  // own angular frequencies along x, y, z [rad/s]

  ModalBody body() const {
    ModalBody one;
    one.name = "mass";
    one.shapes = Eigen::MatrixXd::Identity(3, 3) / std::sqrt(mass);
    one.omega_squared = omega.array().square();
    one.damping = Eigen::VectorXd::Zero(3);
    one.inertia = Eigen::VectorXd::Ones(3);
    one.rigid = Eigen::MatrixXd::Zero(3, 6);
    one.is_rotation = {0, 0, 0};
    one.mass = mass;
    return one;
  }

  /// Shape integrals of the point mass in modal coordinates, N = I / sqrt(m).
  rom::InertiaInvariants invariants() const {
    rom::InertiaInvariants found;
    const double root = std::sqrt(mass);
    for (int k = 0; k < 3; ++k) {
      const Vector3d axis = Vector3d::Unit(k);
      found.first[k] = root * axis;
      for (int l = 0; l < 3; ++l) {
        found.moment[3 * l + k] = root * place(l) * axis;
        found.product[3 * k + l] = axis * Vector3d::Unit(l).transpose();
      }
    }
    found.place = mass * place * place.transpose();
    return found;
  }
};

/// Position of the mass in space after `end`, with a frame that turns about z with spin w and whose
/// origin accelerates with a in the frame's axes.
Vector3d displacement(const MassOnSprings& one, std::function<rom::FrameMotion(double)> motion,
                      const Vector3d& u, const Vector3d& rate, double end, double* residue) {
  System system;
  const int body = system.add_body(one.body());
  std::vector<int> y;
  for (int k = 0; k < 3; ++k) y.push_back(system.modal_coordinate(body, k));
  system.add_element(std::make_unique<MovingFrame>("mass", y, one.invariants(), motion));
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = 1e-3;
  options.first = 1e-9;
  options.accuracy = {1e-6, 1e-2, 1.0, 1.0};
  Dirk method(system, options);
  method.set_observer(&energy);
  const double root = std::sqrt(one.mass);
  method.start(-options.first, root * u, root * rate);
  while (method.state().time < end) method.step(end);
  if (residue != nullptr) *residue = energy.residue();
  return method.state().eta / root;
}

TEST(MovingFrame, AMassInATurningFrameStretchesAsItsSpringSoftens) {
  // In equilibrium u = place W^2 / (w_x^2 - W^2), at any W below w_x: it stays there.
  const MassOnSprings one;
  const double W = 30.0;
  const auto turning = [W](double) {
    rom::FrameMotion motion;
    motion.omega = {0.0, 0.0, W};
    return motion;
  };
  const Vector3d u(one.place.x() * W * W / (50.0 * 50.0 - W * W), 0.0, 0.0);
  const Vector3d found = displacement(one, turning, u, Vector3d::Zero(), 1.0, nullptr);
  EXPECT_LT((found - u).norm(), 1e-8 * u.norm());
}

TEST(MovingFrame, AFreeMassMovesStraightWhateverItsFrameDoes) {
  // Without springs the mass keeps its velocity in space: an oracle that knows no inertia force.
  MassOnSprings one;
  one.omega.setConstant(1e-6);
  const double W = 3.0,
               A = 2.0;  // spin W + A t about z, origin accelerates with (1, 0.5, 0) in space
  const auto angle = [=](double t) { return W * t + 0.5 * A * t * t; };
  const Vector3d a(1.0, 0.5, 0.25);
  const auto motion = [=](double t) {
    rom::FrameMotion at;
    at.omega = {0.0, 0.0, W + A * t};
    at.omega_rate = {0.0, 0.0, A};
    at.acceleration = Eigen::AngleAxisd(-angle(t), Vector3d::UnitZ()) * a;
    return at;
  };
  const double end = 0.4;
  const Vector3d rate(0.1, -0.2, 0.3);
  const Vector3d found = displacement(one, motion, Vector3d::Zero(), rate, end, nullptr);
  // In space: start at place with velocity rate + W x place; the origin is at a t^2 / 2.
  const Vector3d v = rate + Vector3d(0.0, 0.0, W).cross(one.place);
  const Vector3d in_space = one.place + v * end - 0.5 * a * end * end;
  const Vector3d expected =
      Eigen::AngleAxisd(-angle(end), Vector3d::UnitZ()) * in_space - one.place;
  EXPECT_LT((found - expected).norm(), 2e-5 * expected.norm());
}

TEST(MovingFrame, AFreeMassMovesStraightInAFrameThatADriveWithOrdersTurns) {
  MassOnSprings one;
  one.omega.setConstant(1e-6);
  const Drive drive(8.0, 0.0, {{1.0, 1.5, 0.3}, {2.0, 0.5, -0.4}});
  const Vector3d arm(0.1, 0.05, 0.0), rate(0.1, -0.2, 0.3), axis = Vector3d::UnitZ();
  const double end = 0.4;
  const Vector3d found =
      displacement(one, turning_frame(drive, axis, arm), Vector3d::Zero(), rate, end, nullptr);
  const Vector3d at = arm + one.place;
  const Vector3d in_space = at + (rate + drive.at(0.0).velocity * axis.cross(at)) * end;
  const Vector3d expected = Eigen::AngleAxisd(-drive.at(end).position, axis) * in_space - at;
  EXPECT_LT((found - expected).norm(), 2e-5 * expected.norm());
}

TEST(MovingFrame, WithoutRotationItIsEquationTen) {
  // p* = -m a for every mass: the displacement is that of a load on a body at rest, to the bit.
  const MassOnSprings one;
  const Vector3d a(3.0, -2.0, 1.0);
  const auto shaking = [a](double t) {
    rom::FrameMotion motion;
    motion.acceleration = std::sin(40.0 * t) * a;
    return motion;
  };
  const auto invariants = one.invariants();
  for (const double t : {0.01, 0.5}) {
    const Vector3d p =
        invariants.force(shaking(t), Vector3d(1.0, 2.0, 3.0), Vector3d(4.0, 5.0, 6.0));
    EXPECT_LT((p + std::sqrt(one.mass) * std::sin(40.0 * t) * a).norm(), 1e-15);
  }
  double residue = 1.0;
  displacement(one, shaking, Vector3d::Zero(), Vector3d::Zero(), 1.0, &residue);
  EXPECT_LT(residue, 1e-4);  // the drive's work is counted
}

}  // namespace
}  // namespace clatter::dynamics
