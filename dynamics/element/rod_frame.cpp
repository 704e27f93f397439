// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/rod_frame.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace clatter::dynamics {

RodFrame::RodFrame(std::string name, std::vector<int> coordinates, RodCoupling coupling,
                   const SliderCrank& crank)
    : RodFrame(std::move(name), std::move(coordinates), std::move(coupling),
               [crank](double time) { return crank.rod_angle(time); }, {}) {}

RodFrame::RodFrame(std::string name, std::vector<int> coordinates, RodCoupling coupling,
                   std::function<Motion<double>(double time)> angle,
                   std::function<double(double time)> stretch)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      angle_(std::move(angle)),
      stretch_(std::move(stretch)),
      spin_(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN())) {
  const Eigen::Index n = coupling.stretch.size();
  const Eigen::VectorXd g = coupling.stretch / std::sqrt(coupling.inertia);
  by_square_.setZero(1 + n, 1 + n);
  by_square_.bottomRightCorner(n, n) = coupling.square;
  by_turning_.setZero(1 + n, 1 + n);
  by_turning_.bottomRightCorner(n, n) = coupling.circulation;
  by_rate_ = 2.0 * by_turning_;
  by_turning_.row(0).tail(n) = -2.0 * g.transpose();
  by_rate_.row(0).tail(n) = -2.0 * g.transpose();
  by_rate_.col(0).tail(n) = 2.0 * g;
  if (!stretch_) return;
  g_.setZero(1 + n);
  g_.tail(n) = coupling.stretch;
}

void RodFrame::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) {
  const Motion<double> angle = angle_(stage.time);
  const double w = angle.velocity;
  if (w != spin_.x() || angle.acceleration != spin_.y()) {
    spin_ = {w, angle.acceleration};
    by_y_ = w * w * by_square_ + angle.acceleration * by_turning_;
    by_v_ = w * by_rate_;
  }
  response.force.noalias() = by_y_ * y;
  response.force.noalias() += by_v_ * v;
  if (stretch_) {
    load_ = stretch_(stage.time) * w * w * g_;
    response.force += load_;
  }
  if (with_tangent) response.tangent = by_y_ + by_v_ / stage.kappa;
}

Power RodFrame::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  return {0.0, 0.0, v.dot(by_y_ * y + by_v_ * v) + (stretch_ ? load_.dot(v) : 0.0)};
}

}  // namespace clatter::dynamics
