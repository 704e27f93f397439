// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/disc_port.hpp"

#include <Eigen/Geometry>
#include <utility>

#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

DiscPort::DiscPort(std::vector<int> coordinates, const ShaftAxes& axes, const Vector3d& centre,
                   const Vector3d& arm)
    : Port(std::move(coordinates)), axes_(axes), centre_(centre), arm_(arm) {}

Matrix3d DiscPort::turned(double angle) const {
  return Eigen::AngleAxisd(angle, axes_.unit()).toRotationMatrix();
}

Vector3d DiscPort::tilt(const VectorXd& y) const {
  if (!tilts()) return Vector3d::Zero();
  Vector3d tilt = y.tail<3>();
  tilt(axes_.axis) = 0.0;
  return tilt;
}

void DiscPort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(size());
  const Vector3d w = axes_.unit(), t = tilt(y), t_rate = tilt(v);
  const double spin = v(turn());
  state.rotation = turned(y(turn()));
  const Vector3d a = state.rotation * arm_, across = w.cross(a), inward = w.cross(across);
  const Vector3d tilted = t.cross(w);  // the axis beside w
  state.rotation = (Matrix3d::Identity() + skew(t)) * state.rotation;
  const Vector3d swept = across + t.cross(across);
  state.position = centre_ + a + t.cross(a);
  state.velocity = t_rate.cross(a) + spin * swept;
  state.spin = t_rate - t_rate.dot(tilted) * w + spin * (w + tilted);
  state.by_y.col(turn()) << swept, w + tilted;
  state.rate_by_y.col(turn()).head<3>() = t_rate.cross(across) + spin * (inward + t.cross(inward));
  if (tilts()) {
    state.position += y.head<3>();
    state.velocity += v.head<3>();
    state.by_y.topLeftCorner<3, 3>().setIdentity();
    for (const int j : {axes_.first(), axes_.second()}) {
      const Vector3d e = Vector3d::Unit(j), tilting = e.cross(w);
      state.by_y.col(3 + j) << e.cross(a), e - tilted(j) * w;
      state.rate_by_y.col(3 + j) << spin * e.cross(across),
          spin * tilting - t_rate.dot(tilting) * w;
    }
  }
  state.rate_by_v = state.work = state.by_y;
}

void DiscPort::add_curvature(const VectorXd& y, const Vector6& wrench,
                             Eigen::Ref<Eigen::MatrixXd> tangent) {
  const Vector3d w = axes_.unit(), t = tilt(y), force = wrench.head<3>(), moment = wrench.tail<3>();
  const Vector3d across = w.cross(turned(y(turn())) * arm_), inward = w.cross(across);
  tangent(turn(), turn()) += force.dot(inward + t.cross(inward));
  if (!tilts()) return;
  for (const int j : {axes_.first(), axes_.second()}) {
    const Vector3d e = Vector3d::Unit(j);
    const double swept = force.dot(e.cross(across));
    tangent(3 + j, turn()) += swept;
    tangent(turn(), 3 + j) += swept + moment.dot(e.cross(w));
    for (const int k : {axes_.first(), axes_.second()})
      tangent(3 + j, 3 + k) -= moment(axes_.axis) * e.dot(Vector3d::Unit(k).cross(w));
  }
}

}  // namespace clatter::dynamics
