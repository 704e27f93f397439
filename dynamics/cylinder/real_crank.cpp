// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/real_crank.hpp"

#include <cmath>
#include <utility>

namespace clatter::dynamics {

CrankMotion clock_motion(const SliderCrank& crank) {
  return {[crank](double time) { return crank.turn(time); },
          [crank](double time) { return crank.piston_pin(time); },
          [crank](double time) { return crank.rod_angle(time); }};
}

CrankMotion motion_of(std::shared_ptr<const RealCrank> crank) {
  return {[crank](double time) { return crank->turn(time); },
          [crank](double time) { return crank->stroke(time); },
          [crank](double time) { return crank->rod_angle(time); }};
}

void RealCrank::move(const Stage& stage, double turn, double rate) {
  const double angle = sign_ * turn, speed = sign_ * rate;
  double elapsed = stage.kappa, before = angle - stage.kappa * speed, speed_before = 0.0;
  for (size_t j = 0; j < stage.weights.size(); ++j) {
    const Rates& at = j == 0 ? accepted_ : finished_.at(j);
    elapsed += stage.weights[j];
    before -= stage.weights[j] * at.rate;
    speed_before += stage.weights[j] * at.acceleration;
  }
  // The first stage of a run starts where the motion before it is unknown.
  const bool first = stage.index == 0;
  const double acceleration = first ? 0.0 : (speed - accepted_.rate - speed_before) / stage.kappa;
  start_ = {stage.time - elapsed,
            {before, first ? speed : accepted_.rate, first ? 0.0 : accepted_.acceleration}};
  now_ = {stage.time, {angle, speed, acceleration}};
}

void RealCrank::finish_stage(const Stage& stage) {
  finished_.resize(static_cast<size_t>(stage.index) + 1);
  finished_.back() = {now_.deviation.velocity, now_.deviation.acceleration};
}

void RealCrank::accept_step() { accepted_ = finished_.back(); }

Motion<double> RealCrank::turn(double time) const {
  const bool at_start = std::abs(time - start_.time) < std::abs(time - now_.time);
  const Motion<double>& more = at_start ? start_.deviation : now_.deviation;
  const Motion<double> clock = crank_.turn(time);
  return {clock.position + more.position, clock.velocity + more.velocity,
          clock.acceleration + more.acceleration};
}

}  // namespace clatter::dynamics
