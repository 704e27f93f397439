// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/disc_contact.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Sine of the angle between the disc and the plane below which it lies flat.
constexpr double kFlat = 1e-6;

}  // namespace

/// The lowest point of the edge and the force there.
struct DiscContact::Touch {
  Vector3d axis, down;   // of the disc; from its centre to the lowest point, unit vectors
  double steepness = 0;  // sine of the angle between disc and plane
  double depth = 0, rate = 0, normal = 0;
  Vector3d arm, slip;    // from the centre [m]; velocity in the plane [m/s]
  double slip_norm = 0;  // sqrt(v_t^2 + v_s^2)
  Vector3d force;
};

DiscContact::DiscContact(std::string name, std::vector<int> coordinates,
                         std::shared_ptr<const SpatialFrame> frame, const Vector3d& axis,
                         double radius, const DiscPlane& plane)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      frame_(std::move(frame)),
      axis_(axis),
      radius_(radius),
      plane_(plane) {}

DiscContact::Touch DiscContact::touch(const VectorXd& y, const VectorXd& v) const {
  frame_->rotate(time_, y, v, state_);
  const Vector3d& n = plane_.normal;
  Touch at;
  at.axis = state_.A * axis_;
  const Vector3d slope = n.dot(at.axis) * at.axis - n;
  at.steepness = slope.norm();
  if (!(at.steepness > kFlat))
    throw StepRefused(name_ + ": the disc lies flat on the plane",
                      fmt::format("sine of its angle to the plane {:.3g}", at.steepness));
  at.down = slope / at.steepness;
  at.arm = radius_ * at.down;
  const Vector3d velocity = v.segment<3>(kCentre) + state_.spin.cross(at.arm);
  at.depth = std::max(0.0, n.dot(plane_.point - y.segment<3>(kCentre) - at.arm));
  at.rate = -n.dot(velocity);
  at.normal = std::max(0.0, at.depth * (plane_.stiffness + plane_.damping * at.rate));
  at.slip = velocity + at.rate * n;
  at.slip_norm = std::hypot(at.slip.norm(), plane_.slip_speed);
  at.force = at.normal * (n - plane_.friction / at.slip_norm * at.slip);
  return at;
}

void DiscContact::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                           bool with_tangent, Response& response) {
  time_ = stage.time;
  const Touch at = touch(y, v);
  response.force.setZero(kSpatial);
  response.force.segment<3>(kCentre) = at.force;
  response.force.segment<3>(kMomentum) = at.arm.cross(at.force);
  if (!with_tangent) return;
  response.tangent.setZero(kSpatial, kSpatial);
  if (at.normal == 0.0) return;
  frame_->differentiate(y, state_);
  using Matrix = Eigen::Matrix<double, 3, kSpatial>;
  const Vector3d& n = plane_.normal;
  const Matrix3d I = Matrix3d::Identity(), flat = I - n * n.transpose();
  // The lowest point moves along the edge as the axis turns: d axis = turn x axis.
  const Matrix3d by_turn = radius_ / at.steepness * (I - at.down * at.down.transpose()) *
                           (at.axis * n.transpose() + n.dot(at.axis) * I) * -skew(at.axis);
  Matrix arm = Matrix::Zero(),
         velocity = -skew(at.arm) * (state_.spin_by_y + state_.spin_by_v / stage.kappa);
  arm.middleCols<4>(kTurn) = by_turn * state_.turn;
  velocity += skew(state_.spin) * arm;
  velocity.middleCols<3>(kCentre) += I / stage.kappa;
  Matrix down = arm;
  down.middleCols<3>(kCentre) += I;
  const Eigen::Matrix<double, 1, kSpatial> normal =
      -(plane_.stiffness + plane_.damping * at.rate) * n.transpose() * down -
      at.depth * plane_.damping * n.transpose() * velocity;
  const Vector3d direction = at.slip / at.slip_norm;
  const Matrix3d by_slip = (I - direction * direction.transpose()) * flat / at.slip_norm;
  const Matrix force =
      (n - plane_.friction * direction) * normal - plane_.friction * at.normal * by_slip * velocity;
  response.tangent.middleRows<3>(kCentre) = force;
  response.tangent.middleRows<3>(kMomentum) = skew(at.arm) * force - skew(at.force) * arm;
}

Power DiscContact::power(const VectorXd& y, const VectorXd& v) const {
  const Touch at = touch(y, v);
  const double elastic = plane_.stiffness * at.depth;
  return {0.5 * elastic * at.depth, (at.normal - elastic) * at.rate - at.force.dot(at.slip), 0.0};
}

}  // namespace clatter::dynamics
