// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/real_crank_element.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

RealCrankElement::RealCrankElement(std::unique_ptr<ForceElement> element,
                                   std::shared_ptr<RealCrank> crank, int turn,
                                   std::optional<ReferredCoordinate> referred)
    : ForceElement(element->coordinates()),
      element_(std::move(element)),
      crank_(std::move(crank)),
      referred_(std::move(referred)) {
  if (referred_)
    place_ = std::find(coordinates_.begin(), coordinates_.end(), referred_->coordinate) -
             coordinates_.begin();
  coordinates_.push_back(turn);
}

void RealCrankElement::evaluate_at(const Stage& stage, double turn, double rate,
                                   bool with_tangent) {
  crank_->move(stage, turn, rate);
  y_ = given_y_;
  v_ = given_v_;
  if (referred_) {
    const auto apart = [&](double time) {
      const Motion<double> real = referred_->ideal(crank_->clock(), crank_->turn(time)),
                           clock = referred_->ideal(crank_->clock(), crank_->clock().turn(time));
      return Motion<double>{real.position - clock.position, real.velocity - clock.velocity, 0.0};
    };
    const Motion<double> start = apart(crank_->start());
    last_.rate = apart(stage.time).velocity;
    last_.value = start.position + stage.kappa * last_.rate;
    for (size_t j = 0; j < stage.weights.size(); ++j)
      last_.value += stage.weights[j] * (j == 0 ? start.velocity : rates_.at(j));
    y_(place_) -= last_.value;
    v_(place_) -= last_.rate;
  }
  element_->evaluate(stage, y_, v_, with_tangent, at_);
  if (referred_) last_.force = at_.force(place_);
}

void RealCrankElement::evaluate(const Stage& stage, const Eigen::VectorXd& y,
                                const Eigen::VectorXd& v, bool with_tangent, Response& response) {
  const Eigen::Index n = y.size() - 1;
  given_y_ = y.head(n);
  given_v_ = v.head(n);
  constexpr double kPart = 1e-5;  // of the speed, in the difference by the angle
  const double step = kPart * stage.kappa * std::abs(crank_->clock().spin(stage.time));
  Eigen::VectorXd moved;
  if (with_tangent) {
    evaluate_at(stage, y(n) + step, v(n) + step / stage.kappa, false);
    moved = at_.force;
  }
  // Last, so that what the element keeps of its evaluation is that of this state.
  evaluate_at(stage, y(n), v(n), with_tangent);
  response.force.resize(n + 1);
  response.force << at_.force, 0.0;
  response.touched = at_.touched;
  if (!response.touched.empty()) response.touched.push_back(static_cast<int>(n));
  if (with_tangent) add_column(moved, step, response);
}

void RealCrankElement::add_column(const Eigen::VectorXd& moved, double step,
                                  Response& response) const {
  const Eigen::Index n = at_.tangent.rows();
  response.tangent.setZero(n + 1, n + 1);
  response.tangent.topLeftCorner(n, n) = at_.tangent;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index at = at_.touched.empty() ? i : at_.touched[i];
    response.tangent(i, n) = (moved(at) - at_.force(at)) / step;
  }
}

void RealCrankElement::finish_stage(const Stage& stage) {
  element_->finish_stage(stage);
  crank_->finish_stage(stage);
  rates_.resize(static_cast<size_t>(stage.index) + 1);
  rates_.back() = last_.rate;
}

void RealCrankElement::accept_step(double time) {
  element_->accept_step(time);
  crank_->accept_step();
}

Power RealCrankElement::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const Eigen::Index n = y.size() - 1;
  Eigen::VectorXd own_y = y.head(n), own_v = v.head(n);
  if (referred_) {
    own_y(place_) -= last_.value;
    own_v(place_) -= last_.rate;
  }
  Power power = element_->power(own_y, own_v);
  power.input += last_.force * last_.rate;
  return power;
}

std::vector<double> RealCrankElement::save() const {
  std::vector<double> state = element_->save();
  for (const double value : crank_->save()) state.push_back(value);
  return state;
}

void RealCrankElement::restore(const std::vector<double>& state) {
  if (state.size() < RealCrank::kSaved)
    throw InputError(fmt::format("{}: the saved state has {} numbers, expected {} or more", name(),
                                 state.size(), RealCrank::kSaved));
  const auto own = state.end() - RealCrank::kSaved;
  crank_->restore(own[0], own[1]);
  const std::vector<double> rest(state.begin(), own);
  if (!rest.empty() || !element_->save().empty()) element_->restore(rest);
}

CrankView::CrankView(const CylinderBodies& bodies, const SliderCrank& crank) {
  if (!bodies.spec.has_free_crank()) {
    motion_ = clock_motion(crank);
    return;
  }
  crank_ = std::make_shared<RealCrank>(crank);
  turn_ = bodies.model.system.coordinate(bodies.model.body(CrankBody::kName),
                                         bodies.spec.crankshaft->turn());
  motion_ = motion_of(crank_);
}

std::unique_ptr<ForceElement> CrankView::follow(std::unique_ptr<ForceElement> element,
                                                std::optional<ReferredCoordinate> referred) const {
  if (!crank_ || !element) return element;
  return std::make_unique<RealCrankElement>(std::move(element), crank_, turn_, std::move(referred));
}

ReferredCoordinate along_stroke(int coordinate) {
  return {coordinate, [](const SliderCrank& crank, const Motion<double>& theta) {
            return crank.piston_pin(theta);
          }};
}

}  // namespace clatter::dynamics
