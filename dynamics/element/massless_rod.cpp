// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/massless_rod.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr int kRod = 3;  // coordinates

std::vector<int> joined(const ForceElement& pin, const ForceElement& crank_pin) {
  std::vector<int> all(pin.coordinates().begin(), pin.coordinates().end() - kRod);
  all.insert(all.end(), crank_pin.coordinates().begin(), crank_pin.coordinates().end() - kRod);
  return all;
}

}  // namespace

MasslessRod::MasslessRod(std::string name, std::unique_ptr<ForceElement> pin,
                         std::unique_ptr<ForceElement> crank_pin)
    : ForceElement(joined(*pin, *crank_pin)),
      name_(std::move(name)),
      pin_(std::move(pin)),
      crank_pin_(std::move(crank_pin)),
      n_pin_(std::ssize(pin_->coordinates()) - kRod),
      n_crank_(std::ssize(crank_pin_->coordinates()) - kRod) {
  y_pin_.resize(n_pin_ + kRod);
  v_pin_.resize(n_pin_ + kRod);
  y_crank_.resize(n_crank_ + kRod);
  v_crank_.resize(n_crank_ + kRod);
}

Vector3d MasslessRod::balance(const Stage& stage, const VectorXd& y, const VectorXd& v) {
  const Vector3d rate = (x_ - before_) / stage.kappa;
  y_pin_ << y.head(n_pin_), x_;
  v_pin_ << v.head(n_pin_), rate;
  y_crank_ << y.tail(n_crank_), x_;
  v_crank_ << v.tail(n_crank_), rate;
  pin_->evaluate(stage, y_pin_, v_pin_, true, at_pin_);
  crank_pin_->evaluate(stage, y_crank_, v_crank_, true, at_crank_);
  by_x_ = at_pin_.tangent.bottomRightCorner<kRod, kRod>() +
          at_crank_.tangent.bottomRightCorner<kRod, kRod>();
  return at_pin_.force.tail<kRod>() + at_crank_.force.tail<kRod>();
}

void MasslessRod::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                           bool with_tangent, Response& response) {
  before_ = accepted_;
  for (size_t j = 0; j < stage.weights.size(); ++j) before_ += stage.weights[j] * rates_.at(j);
  // Newton's method with halved steps: the laws of the joints are monotone in the eccentricity.
  constexpr int kMost = 60;
  constexpr double kBalanced = 1e-13;  // of the forces that it sums: rounding
  Vector3d left = balance(stage, y, v);
  const auto size = [&] {
    return at_pin_.force.tail<kRod>().cwiseAbs().maxCoeff() +
           at_crank_.force.tail<kRod>().cwiseAbs().maxCoeff() + 1e-3;
  };
  int count = 0;
  for (; count < kMost && !(left.cwiseAbs().maxCoeff() <= kBalanced * size()); ++count) {
    const Vector3d step = by_x_.partialPivLu().solve(-left), from = x_;
    const double norm = left.norm();
    double share = 1.0;
    x_ = from + step;
    left = balance(stage, y, v);
    for (; !(left.norm() < norm) && share > 1e-3; left = balance(stage, y, v)) {
      share *= 0.5;
      x_ = from + share * step;
    }
    const bool rounding = (x_ - from).cwiseAbs().maxCoeff() <= 1e-18;
    if (rounding || share <= 1e-3) break;  // as good as it gets, or at no better point
  }
  constexpr double kAccepted = 1e-9;
  if (!(left.cwiseAbs().maxCoeff() <= kAccepted * size())) {
    x_ = accepted_;
    throw StepRefused(name_ + ": the forces of its joints do not balance",
                      fmt::format("{:.3g} of {:.3g} N are left after {} iterations",
                                  left.cwiseAbs().maxCoeff(), size(), count));
  }
  response.force.resize(n_pin_ + n_crank_);
  response.force << at_pin_.force.head(n_pin_), at_crank_.force.head(n_crank_);
  if (!with_tangent) return;
  // What the rod follows by: df/dy - df/dx (dr/dx)^-1 dr/dy.
  Eigen::MatrixXd& T = response.tangent;
  T.setZero(n_pin_ + n_crank_, n_pin_ + n_crank_);
  T.topLeftCorner(n_pin_, n_pin_) = at_pin_.tangent.topLeftCorner(n_pin_, n_pin_);
  T.bottomRightCorner(n_crank_, n_crank_) = at_crank_.tangent.topLeftCorner(n_crank_, n_crank_);
  Eigen::Matrix<double, kRod, Eigen::Dynamic> r_by_y(kRod, n_pin_ + n_crank_);
  r_by_y << at_pin_.tangent.bottomLeftCorner(kRod, n_pin_),
      at_crank_.tangent.bottomLeftCorner(kRod, n_crank_);
  Eigen::Matrix<double, Eigen::Dynamic, kRod> f_by_x(n_pin_ + n_crank_, kRod);
  f_by_x << at_pin_.tangent.topRightCorner(n_pin_, kRod),
      at_crank_.tangent.topRightCorner(n_crank_, kRod);
  T.noalias() -= f_by_x * by_x_.partialPivLu().solve(r_by_y);
}

void MasslessRod::begin_step(double) {
  rates_.assign(1, accepted_rate_);
  x_ = accepted_;
}

void MasslessRod::finish_stage(const Stage& stage) {
  pin_->finish_stage(stage);
  crank_pin_->finish_stage(stage);
  const auto index = static_cast<size_t>(stage.index);
  rates_.resize(index + 1, Vector3d::Zero());
  rates_[index] = (x_ - before_) / stage.kappa;
  finished_ = x_;
}

void MasslessRod::accept_step(double time) {
  pin_->accept_step(time);
  crank_pin_->accept_step(time);
  accepted_ = finished_;
  accepted_rate_ = rates_.back();
}

Power MasslessRod::power(const VectorXd& y, const VectorXd& v) const {
  const Power pin = pin_->power(y, v), crank = crank_pin_->power(y, v);
  return {pin.stored + crank.stored, pin.lost + crank.lost, pin.input + crank.input};
}

void MasslessRod::record(History& history) const {
  pin_->record(history);
  crank_pin_->record(history);
}

std::vector<double> MasslessRod::save() const {
  std::vector<double> state(accepted_.begin(), accepted_.end());
  state.insert(state.end(), accepted_rate_.begin(), accepted_rate_.end());
  return state;
}

void MasslessRod::restore(const std::vector<double>& state) {
  if (state.size() != 2 * kRod)
    throw InputError(fmt::format("{}: the saved state has {} numbers, expected {}", name_,
                                 state.size(), 2 * kRod));
  for (int k = 0; k < kRod; ++k) {
    accepted_(k) = state[k];
    accepted_rate_(k) = state[kRod + k];
  }
}

}  // namespace clatter::dynamics
