// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/port.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "dynamics/force/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

void clear(PortState& state, int size) {
  for (Matrix6X* matrix : {&state.by_y, &state.rate_by_y, &state.rate_by_v, &state.work})
    matrix->setZero(6, size);
}

// Positions of a spatial body's coordinates.
constexpr int kCentre = 0, kQuaternion = 3, kSpin = 7;

}  // namespace

void GroundPort::motion(double, const VectorXd&, const VectorXd&, PortState& state) const {
  clear(state, 0);
  state.position = position_;
  state.velocity.setZero();
  state.spin.setZero();
}

DrivenPort::DrivenPort(Drive drive, const Vector3d& centre, const Vector3d& arm,
                       const Vector3d& axis)
    : Port({}), drive_(std::move(drive)), centre_(centre), arm_(arm), axis_(axis) {}

void DrivenPort::motion(double time, const VectorXd&, const VectorXd&, PortState& state) const {
  clear(state, 0);
  const Motion<double> turn = drive_.at(time);
  const Vector3d arm = Eigen::AngleAxisd(turn.position, axis_) * arm_;
  state.position = centre_ + arm;
  state.spin = turn.velocity * axis_;
  state.velocity = state.spin.cross(arm);
}

NodePort::NodePort(const Vector3d& position, std::vector<int> coordinates)
    : Port(std::move(coordinates)), position_(position) {}

void NodePort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) const {
  clear(state, size());
  state.position = position_ + y.head<3>();
  state.velocity = v.head<3>();
  state.spin = size() == 6 ? Vector3d(v.tail<3>()) : Vector3d::Zero();
  state.by_y.diagonal().setOnes();
  state.rate_by_v = state.work = state.by_y;
}

PlanarPort::PlanarPort(std::vector<int> coordinates, const Eigen::Vector2d& arm,
                       const PlaneAxes& plane)
    : Port(std::move(coordinates)), arm_(arm), plane_(plane) {}

Vector3d PlanarPort::turned_arm(double angle) const {
  const double s = std::sin(angle), c = std::cos(angle);
  return (c * arm_.x() - s * arm_.y()) * plane_.first +
         (s * arm_.x() + c * arm_.y()) * plane_.second;
}

void PlanarPort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) const {
  clear(state, 3);
  const Vector3d normal = plane_.first.cross(plane_.second), arm = turned_arm(y(2));
  const Vector3d across = normal.cross(arm);
  state.position = plane_.origin + y(0) * plane_.first + y(1) * plane_.second + arm;
  state.velocity = v(0) * plane_.first + v(1) * plane_.second + v(2) * across;
  state.spin = v(2) * normal;
  state.by_y.topRows<3>() << plane_.first, plane_.second, across;
  state.by_y.bottomRows<3>().col(2) = normal;
  state.rate_by_v = state.work = state.by_y;
  state.rate_by_y.topRows<3>().col(2) = -v(2) * arm;
}

void PlanarPort::add_curvature(const VectorXd& y, const Vector6& wrench,
                               Eigen::Ref<Eigen::MatrixXd> tangent) const {
  tangent(2, 2) -= turned_arm(y(2)).dot(wrench.head<3>());
}

SpatialPort::SpatialPort(std::vector<int> coordinates, const Vector3d& arm)
    : Port(std::move(coordinates)), arm_(arm) {}

void SpatialPort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) const {
  clear(state, size());
  const Eigen::Vector4d q = y.segment<4>(kQuaternion);
  const Vector3d w = y.segment<3>(kSpin), speed = w.cross(arm_);
  const Matrix3d A = rotation_matrix(q), by_spin = -A * skew(arm_);
  state.position = y.segment<3>(kCentre) + A * arm_;
  state.velocity = v.segment<3>(kCentre) + A * speed;
  state.spin = A * w;
  state.by_y.topRows<3>().middleCols<3>(kCentre).setIdentity();
  state.by_y.topRows<3>().middleCols<4>(kQuaternion) = rotated_by_quaternion(q, arm_);
  state.by_y.bottomRows<3>().middleCols<4>(kQuaternion) = turn_by_quaternion(q);
  state.rate_by_y.topRows<3>().middleCols<4>(kQuaternion) = rotated_by_quaternion(q, speed);
  state.rate_by_y.topRows<3>().middleCols<3>(kSpin) = by_spin;
  state.rate_by_y.bottomRows<3>().middleCols<4>(kQuaternion) = rotated_by_quaternion(q, w);
  state.rate_by_y.bottomRows<3>().middleCols<3>(kSpin) = A;
  state.rate_by_v.topRows<3>().middleCols<3>(kCentre).setIdentity();
  state.work.topRows<3>().middleCols<3>(kCentre).setIdentity();
  state.work.topRows<3>().middleCols<3>(kSpin) = by_spin;
  state.work.bottomRows<3>().middleCols<3>(kSpin) = A;
}

void SpatialPort::add_curvature(const VectorXd& y, const Vector6& wrench,
                                Eigen::Ref<Eigen::MatrixXd> tangent) const {
  // The moment about the centre in the body's axes, c x A^T F + A^T M; dA^T = -A^T skew(t).
  const Eigen::Vector4d q = y.segment<4>(kQuaternion);
  const Matrix3d back = rotation_matrix(q).transpose();
  tangent.block<3, 4>(kSpin, kQuaternion) +=
      (skew(arm_) * back * skew(wrench.head<3>()) + back * skew(wrench.tail<3>())) *
      turn_by_quaternion(q);
}

}  // namespace clatter::dynamics
