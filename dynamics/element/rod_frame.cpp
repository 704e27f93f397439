// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/rod_frame.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace clatter::dynamics {

RodFrame::RodFrame(std::string name, std::vector<int> coordinates, RodCoupling coupling,
                   const SliderCrank& clock, std::function<double(double time)> stretch,
                   CrankAngle crank)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      clock_(clock),
      stretch_(std::move(stretch)),
      crank_(std::move(crank)),
      scale_(std::sqrt(coupling.inertia)),
      spin_(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN())) {
  const Eigen::Index n = coupling.stretch.size();
  crank_.join(coordinates_);
  const Eigen::VectorXd g = coupling.stretch / scale_;
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
  const Eigen::Index n = by_square_.rows();
  const CrankLead lead = crank_.lead(stage, y, v);
  const Motion<double> ideal = clock_.rod_angle(stage.time + lead.now.position),
                       angle = led(ideal, lead.now);
  const double w = angle.velocity;
  if (w != spin_.x() || angle.acceleration != spin_.y()) {
    spin_ = {w, angle.acceleration};
    by_y_ = w * w * by_square_ + angle.acceleration * by_turning_;
    by_v_ = w * by_rate_;
  }
  rate_ = v.head(n);
  if (crank_.is_free()) rate_(0) -= apart_ = scale_ * (w - clock_.rod_angle(stage.time).velocity);
  response.force.setZero(y.size());
  auto force = response.force.head(n);
  force.noalias() = by_y_ * y.head(n);
  force.noalias() += by_v_ * rate_;
  const double share = stretch_ ? stretch_(stage.time) : 0.0;
  if (stretch_) {
    load_ = share * w * w * g_;
    force += load_;
  }
  if (!with_tangent) return;
  response.tangent.setZero(y.size(), y.size());
  response.tangent.topLeftCorner(n, n) = by_y_ + by_v_ / stage.kappa;
  if (!crank_.is_free()) return;
  const Motion<double> by = led_by_turn(ideal, lead);
  auto column = response.tangent.col(n).head(n);
  column = 2.0 * w * by.velocity * (by_square_ * y.head(n));
  column += by.acceleration * (by_turning_ * y.head(n));
  column += by.velocity * (by_rate_ * rate_ - scale_ * by_v_.col(0));
  if (stretch_) column += 2.0 * w * by.velocity * share * g_;
}

Power RodFrame::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const Eigen::Index n = by_square_.rows();
  const auto own_y = y.head(n), own_v = v.head(n);
  return {0.0, 0.0,
          own_v.dot(by_y_ * own_y + by_v_ * own_v) - apart_ * own_v.dot(by_v_.col(0)) +
              (stretch_ ? load_.dot(own_v) : 0.0)};
}

}  // namespace clatter::dynamics
