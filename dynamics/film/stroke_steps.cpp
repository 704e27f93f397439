// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/stroke_steps.hpp"

namespace clatter::film {

void StrokeSteps::find(const dynamics::Stage& stage, const Eigen::VectorXd& y,
                       const Eigen::VectorXd& v) {
  lead_ = crank_.lead(stage, y, v);
  const StrokeState start = law_(stage.begin()), clock = law_(stage.time),
                    at_crank = law_(stage.time + lead_.now.position);
  double position = start.position + stage.kappa * clock.velocity;
  for (size_t j = 0; j < stage.weights.size(); ++j)
    position += stage.weights[j] * (j == 0 ? start.velocity : clock_rates_.at(j));
  const dynamics::Motion<double> given{at_crank.position, at_crank.velocity, at_crank.acceleration};
  now_.clock = {position, clock.velocity};
  now_.ideal = {position + (given.position - clock.position),
                dynamics::led(given, lead_.now).velocity};
  slide_by_turn_ = dynamics::led_by_turn(given, lead_).velocity;
}

double StrokeSteps::travel(const dynamics::Stage& stage) const {
  const double start = exact(stage.begin(), lead_.begin).ideal.velocity;
  double sum = stage.kappa * now_.ideal.velocity;
  for (size_t j = 0; j < stage.weights.size(); ++j)
    sum += stage.weights[j] * (j == 0 ? start : ideal_rates_.at(j));
  return sum;
}

void StrokeSteps::finish_stage(const dynamics::Stage& stage) {
  clock_rates_.at(stage.index) = now_.clock.velocity;
  ideal_rates_.at(stage.index) = now_.ideal.velocity;
}

PinStroke StrokeSteps::exact(double time, const dynamics::Motion<double>& lead) const {
  const StrokeState at_crank = law_(time + lead.position);
  return {law_(time), {at_crank.position, at_crank.velocity * (1.0 + lead.velocity)}};
}

}  // namespace clatter::film
