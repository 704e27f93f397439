// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/port.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

void PortState::clear(int n) {
  position.setZero();
  velocity.setZero();
  spin.setZero();
  rotation.setIdentity();
  driven.setZero();
  for (Matrix6X* matrix : {&by_y, &rate_by_y, &rate_by_v, &work}) matrix->setZero(6, n);
}

void GroundPort::motion(double, const VectorXd&, const VectorXd&, PortState& state) {
  state.clear(0);
  state.position = position_;
}

DrivenPort::DrivenPort(Drive drive, const Vector3d& centre, const Vector3d& arm,
                       const Vector3d& axis, std::unique_ptr<NodePort> bearing)
    : Port(bearing ? bearing->coordinates() : std::vector<int>{}),
      drive_(std::move(drive)),
      centre_(centre),
      arm_(arm),
      axis_(axis),
      bearing_(std::move(bearing)) {}

void DrivenPort::motion(double time, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(size());
  const Motion<double> turn = drive_.at(time);
  state.rotation = Eigen::AngleAxisd(turn.position, axis_).toRotationMatrix();
  const Vector3d out = state.rotation * arm_;
  state.position = centre_ + out;
  state.spin = turn.velocity * axis_;
  state.velocity = state.spin.cross(out);
  state.driven = wrench(state.velocity, state.spin);
  if (bearing_) add_bearing(y, v, out, state);
}

/// The shaft follows its bearing, with the centre c of the shaft as it is on the bearing's body, in
/// all but the rotation about its axis a, which is the drive's: a force F at p and a moment M act
/// on the bearing as F at c and (1 - a a^T) ((p - c) x F + M).
void DrivenPort::add_bearing(const VectorXd& y, const VectorXd& v, const Vector3d& out,
                             PortState& state) {
  bearing_->motion(0.0, y, v, at_bearing_);
  const Vector3d centre = centre_ - bearing_->place();
  const Eigen::Matrix3d held = Eigen::Matrix3d::Identity() - axis_ * axis_.transpose();
  const Eigen::Matrix3d turn = at_bearing_.rotation - Eigen::Matrix3d::Identity();
  const Vector3d turned(turn(2, 1), turn(0, 2), turn(1, 0)), tilted = held * turned;
  state.position +=
      at_bearing_.position - bearing_->place() + turned.cross(centre) + tilted.cross(out);
  state.rotation += skew(tilted) * state.rotation;
  const Vector3d spin = held * at_bearing_.spin;
  state.velocity += at_bearing_.velocity + at_bearing_.spin.cross(centre) + spin.cross(out);
  state.spin += spin;
  for (int j = 0; j < size(); ++j) {
    const Vector3d by_turn = at_bearing_.by_y.col(j).tail<3>(), by_tilt = held * by_turn;
    state.by_y.col(j) << at_bearing_.by_y.col(j).head<3>() + by_turn.cross(centre) +
                             by_tilt.cross(out),
        by_tilt;
  }
  state.rate_by_v = state.work = state.by_y;
}

NodePort::NodePort(const Vector3d& position, std::vector<int> coordinates)
    : Port(std::move(coordinates)), position_(position) {}

void NodePort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(size());
  state.position = position_ + y.head<3>();
  state.velocity = v.head<3>();
  if (size() == 6) {
    state.spin = v.tail<3>();
    state.rotation += skew(y.tail<3>());
  }
  state.by_y.diagonal().setOnes();
  state.rate_by_v = state.work = state.by_y;
}

TurningNodePort::TurningNodePort(Drive shaft, const Vector3d& centre, const Vector3d& axis,
                                 double start, const Vector3d& position,
                                 std::vector<int> coordinates)
    : Port(std::move(coordinates)),
      shaft_(std::move(shaft)),
      centre_(centre),
      axis_(axis),
      arm_(position - centre),
      start_(start) {}

void TurningNodePort::motion(double time, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(size());
  const Motion<double> turn = shaft_.at(time);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turn.position - start_, axis_).toRotationMatrix();
  const Vector3d spin = turn.velocity * axis_, out = R * (arm_ + y.head<3>());
  state.position = centre_ + out;
  state.driven = wrench(spin.cross(out), spin);
  state.velocity = spin.cross(out) + R * v.head<3>();
  state.spin = spin;
  state.rotation = R;
  state.by_y.topLeftCorner<3, 3>() = R;
  state.rate_by_y.topLeftCorner<3, 3>() = skew(spin) * R;
  if (size() == 6) {
    state.spin += R * v.tail<3>();
    state.rotation += R * skew(y.tail<3>());
    state.by_y.bottomRightCorner<3, 3>() = R;
  }
  state.rate_by_v = state.work = state.by_y;
}

PlanarPort::PlanarPort(std::vector<int> coordinates, const Vector2d& arm, const PlaneAxes& plane)
    : Port(std::move(coordinates)), arm_(arm), plane_(plane) {}

Vector3d PlanarPort::turned(const Vector2d& arm, double angle) const {
  const double s = std::sin(angle), c = std::cos(angle);
  return (c * arm.x() - s * arm.y()) * plane_.first + (s * arm.x() + c * arm.y()) * plane_.second;
}

void PlanarPort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(3);
  const Vector3d normal = plane_.first.cross(plane_.second), arm = turned(arm_, y(2));
  const Vector3d across = normal.cross(arm);
  state.position = plane_.origin + y(0) * plane_.first + y(1) * plane_.second + arm;
  state.velocity = v(0) * plane_.first + v(1) * plane_.second + v(2) * across;
  state.spin = v(2) * normal;
  state.rotation.noalias() = turned(Vector2d::UnitX(), y(2)) * plane_.first.transpose();
  state.rotation.noalias() += turned(Vector2d::UnitY(), y(2)) * plane_.second.transpose();
  state.rotation.noalias() += normal * normal.transpose();
  state.by_y.topRows<3>() << plane_.first, plane_.second, across;
  state.by_y.bottomRows<3>().col(2) = normal;
  state.rate_by_v = state.work = state.by_y;
  state.rate_by_y.topRows<3>().col(2) = -v(2) * arm;
}

void PlanarPort::add_curvature(const VectorXd& y, const Vector6& wrench,
                               Eigen::Ref<Eigen::MatrixXd> tangent) {
  tangent(2, 2) -= turned(arm_, y(2)).dot(wrench.head<3>());
}

SlidePort::SlidePort(int coordinate, const Vector3d& axis, const Vector3d& start,
                     std::unique_ptr<Port> guide, const Vector3d& guide_start)
    : Port({coordinate}),
      axis_(axis),
      start_(start),
      guide_start_(guide_start),
      across_(Eigen::Matrix3d::Identity() - axis * axis.transpose()),
      guide_(std::move(guide)) {
  const std::vector<int>& more = guide_->coordinates();
  coordinates_.insert(coordinates_.end(), more.begin(), more.end());
}

void SlidePort::motion(double time, const VectorXd& y, const VectorXd& v, PortState& state) {
  const int n = guide_->size();
  guide_y_ = y.tail(n);
  guide_v_ = v.tail(n);
  guide_->motion(time, guide_y_, guide_v_, at_guide_);
  state.clear(size());
  state.position = start_ + y(0) * axis_ + across_ * (at_guide_.position - guide_start_);
  state.velocity = v(0) * axis_ + across_ * at_guide_.velocity;
  state.spin = at_guide_.spin;
  state.rotation = at_guide_.rotation;
  const auto follow = [&](const Matrix6X& guide, Matrix6X& own) {
    for (int j = 0; j < n; ++j) {
      own.col(j + 1).head<3>() = across_ * guide.col(j).head<3>();
      own.col(j + 1).tail<3>() = guide.col(j).tail<3>();
    }
  };
  follow(at_guide_.by_y, state.by_y);
  follow(at_guide_.rate_by_y, state.rate_by_y);
  follow(at_guide_.rate_by_v, state.rate_by_v);
  follow(at_guide_.work, state.work);
  for (Matrix6X* matrix : {&state.by_y, &state.rate_by_v, &state.work})
    matrix->col(0).head<3>() = axis_;
}

void SlidePort::add_curvature(const VectorXd& y, const Vector6& wrench,
                              Eigen::Ref<Eigen::MatrixXd> tangent) {
  const int n = guide_->size();
  guide_y_ = y.tail(n);
  Vector6 on_guide = wrench;
  on_guide.head<3>() = across_ * wrench.head<3>();
  guide_->add_curvature(guide_y_, on_guide, tangent.bottomRightCorner(n, n));
}

}  // namespace clatter::dynamics
