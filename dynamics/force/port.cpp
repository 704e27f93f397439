// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/port.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "dynamics/force/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

void clear(PortState& state, int size) {
  for (Matrix6X* matrix : {&state.by_y, &state.rate_by_y, &state.rate_by_v, &state.work})
    matrix->setZero(6, size);
}

}  // namespace

void GroundPort::motion(double, const VectorXd&, const VectorXd&, PortState& state) const {
  clear(state, 0);
  state.position = position_;
  state.velocity.setZero();
  state.spin.setZero();
  state.rotation.setIdentity();
}

DrivenPort::DrivenPort(Drive drive, const Vector3d& centre, const Vector3d& arm,
                       const Vector3d& axis)
    : Port({}), drive_(std::move(drive)), centre_(centre), arm_(arm), axis_(axis) {}

void DrivenPort::motion(double time, const VectorXd&, const VectorXd&, PortState& state) const {
  clear(state, 0);
  const Motion<double> turn = drive_.at(time);
  state.rotation = Eigen::AngleAxisd(turn.position, axis_).toRotationMatrix();
  const Vector3d arm = state.rotation * arm_;
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
  state.spin.setZero();
  state.rotation.setIdentity();
  if (size() == 6) {
    state.spin = v.tail<3>();
    state.rotation += skew(y.tail<3>());
  }
  state.by_y.diagonal().setOnes();
  state.rate_by_v = state.work = state.by_y;
}

PlanarPort::PlanarPort(std::vector<int> coordinates, const Vector2d& arm,
                       const PlaneAxes& plane)
    : Port(std::move(coordinates)), arm_(arm), plane_(plane) {}

Vector3d PlanarPort::turned(const Vector2d& arm, double angle) const {
  const double s = std::sin(angle), c = std::cos(angle);
  return (c * arm.x() - s * arm.y()) * plane_.first + (s * arm.x() + c * arm.y()) * plane_.second;
}

void PlanarPort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) const {
  clear(state, 3);
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
                               Eigen::Ref<Eigen::MatrixXd> tangent) const {
  tangent(2, 2) -= turned(arm_, y(2)).dot(wrench.head<3>());
}

}  // namespace clatter::dynamics
