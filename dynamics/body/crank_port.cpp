// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/crank_port.hpp"

#include <Eigen/Geometry>
#include <utility>

#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Vector3d;
using Eigen::VectorXd;

Motion<double> turn_about_x(const CrankClock& clock, Rotation rotation, double time) {
  const double sign = rotation == Rotation::kForward ? 1.0 : -1.0;
  const Motion<double> turn = clock.turn(time);
  return {sign * turn.position, sign * turn.velocity, sign * turn.acceleration};
}

CrankPort::CrankPort(std::vector<int> coordinates, double x, double arm, CrankClock clock,
                     Rotation rotation)
    : Port(std::move(coordinates)),
      x_(x),
      arm_(arm),
      clock_(std::move(clock)),
      rotation_(rotation) {}

void CrankPort::motion(double time, const VectorXd& y, const VectorXd& v, PortState& state) {
  const Motion<double> turn = turn_about_x(clock_, rotation_, time);
  state.clear(size());
  state.driven(3) = turn.velocity;
  const bool is_free = size() == 5;
  const double more = is_free ? y(4) : 0.0, rate = is_free ? v(4) : 0.0;
  state.position = {x_, y(0) + y(3) * arm_, y(1) - y(2) * arm_};
  state.velocity = {0.0, v(0) + v(3) * arm_, v(1) - v(2) * arm_};
  state.spin = {turn.velocity + rate, v(2), v(3)};
  state.rotation = (Eigen::Matrix3d::Identity() + skew(Vector3d(0.0, y(2), y(3)))) *
                   Eigen::AngleAxisd(turn.position + more, Vector3d::UnitX());
  state.by_y(1, 0) = state.by_y(2, 1) = state.by_y(4, 2) = state.by_y(5, 3) = 1.0;
  state.by_y(1, 3) = arm_;
  state.by_y(2, 2) = -arm_;
  if (is_free) state.by_y(3, 4) = 1.0;
  state.rate_by_v = state.work = state.by_y;
}

}  // namespace clatter::dynamics
