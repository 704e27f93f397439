// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/moving_frame.hpp"

#include <Eigen/Geometry>
#include <limits>
#include <utility>

namespace clatter::dynamics {

std::function<rom::FrameMotion(double)> turning_frame(const Drive& drive,
                                                      const Eigen::Vector3d& axis,
                                                      const Eigen::Vector3d& arm) {
  return [drive, axis, arm](double time) {
    const Motion<double> turn = drive.at(time);
    rom::FrameMotion motion;
    motion.omega = turn.velocity * axis;
    motion.omega_rate = turn.acceleration * axis;
    motion.acceleration =
        motion.omega_rate.cross(arm) + motion.omega.cross(motion.omega.cross(arm));
    return motion;
  };
}

MovingFrame::MovingFrame(std::string body, std::vector<int> coordinates,
                         rom::InertiaInvariants invariants,
                         std::function<rom::FrameMotion(double)> motion)
    : ForceElement(std::move(coordinates)),
      body_(std::move(body)),
      invariants_(std::move(invariants)),
      motion_(std::move(motion)),
      time_(std::numeric_limits<double>::quiet_NaN()) {}

void MovingFrame::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                           bool with_tangent, Response& response) {
  if (stage.time != time_) {
    time_ = stage.time;
    const rom::FrameMotion motion = motion_(time_);
    load_ = invariants_.load(motion);
    softening_ = invariants_.softening(motion);
    gyroscopic_ = invariants_.gyroscopic(motion.omega);
  }
  response.force = load_;
  response.force.noalias() -= softening_ * y;
  response.force.noalias() -= gyroscopic_ * v;
  if (with_tangent) response.tangent = -softening_ - gyroscopic_ / stage.kappa;
}

Power MovingFrame::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  return {0.0, 0.0, v.dot(load_ - softening_ * y - gyroscopic_ * v)};
}

}  // namespace clatter::dynamics
