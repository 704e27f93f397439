// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/stroke_steps.hpp"

namespace clatter::film {
namespace {

double begin_of_step(const dynamics::Stage& stage) {
  double elapsed = stage.kappa;
  for (const double weight : stage.weights) elapsed += weight;
  return stage.time - elapsed;
}

}  // namespace

StrokeState StrokeSteps::at(const dynamics::Stage& stage) const {
  const StrokeState start = law_(begin_of_step(stage));
  StrokeState now = law_(stage.time);
  now.position = start.position + stage.kappa * now.velocity;
  for (size_t j = 0; j < stage.weights.size(); ++j)
    now.position += stage.weights[j] * (j == 0 ? start.velocity : rates_.at(j));
  return now;
}

double StrokeSteps::travel(const dynamics::Stage& stage) const {
  const double start = law_(begin_of_step(stage)).velocity;
  double sum = stage.kappa * law_(stage.time).velocity;
  for (size_t j = 0; j < stage.weights.size(); ++j)
    sum += stage.weights[j] * (j == 0 ? start : rates_.at(j));
  return sum;
}

void StrokeSteps::finish_stage(const dynamics::Stage& stage) {
  rates_.at(stage.index) = law_(stage.time).velocity;
}

}  // namespace clatter::film
