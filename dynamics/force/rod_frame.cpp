// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/rod_frame.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace clatter::dynamics {

RodFrame::RodFrame(std::string name, std::vector<int> coordinates, RodCoupling coupling,
                   const SliderCrank& crank)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      crank_(crank),
      time_(std::numeric_limits<double>::quiet_NaN()) {
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
}

void RodFrame::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) {
  if (stage.time != time_) {
    time_ = stage.time;
    const Motion<double> angle = crank_.rod_angle(time_);
    const double w = angle.velocity;
    by_y_ = w * w * by_square_ + angle.acceleration * by_turning_;
    by_v_ = w * by_rate_;
  }
  response.force.noalias() = by_y_ * y;
  response.force.noalias() += by_v_ * v;
  if (with_tangent) response.tangent = by_y_ + by_v_ / stage.kappa;
}

Power RodFrame::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  return {0.0, 0.0, v.dot(by_y_ * y + by_v_ * v)};
}

}  // namespace clatter::dynamics
