// SPDX-License-Identifier: GPL-3.0-or-later
#include "stroke_march.hpp"

#include <cmath>
#include <stdexcept>

#include "film_march.hpp"

namespace clatter::film {
namespace {

Edges edges(const StrokeConditions& conditions) {
  const Edge open = Edge::supply(0.0, 1.0, conditions.layer);
  return strip_edges(open, open);
}

}  // namespace

StrokeMarch::StrokeMarch(int cells, StrokeConditions conditions)
    : conditions_(std::move(conditions)),
      film_(strip(conditions_.begin, conditions_.end, cells), edges(conditions_), true),
      oil_(film_) {
  if (conditions_.remembered) covered_.emplace(film_.pad());
  cells_.set_smooth(Eigen::ArrayXd::Constant(cells, 1.0));
}

Eigen::ArrayXd StrokeMarch::at_cells(const std::function<double(double)>& value) const {
  return along(film_.grid(), value);
}

// The means of 20 points of a cell of the liner; of those of the skirt there are four to a cell.
void StrokeMarch::start(double time, const std::function<double(double)>& liner,
                        const std::function<double(double)>& skirt) {
  const PadGrid& grid = film_.grid();
  const int n = grid.size(), parts = 4, samples = 20;
  const double step = grid.height(0) / parts;
  Eigen::ArrayXd content = Eigen::ArrayXd::Zero(n), held = Eigen::ArrayXd::Zero(parts * n);
  for (int k = 0; k < parts * n; ++k)
    for (int s = 0; s < samples; ++s) {
      const double z = conditions_.begin + (k + (s + 0.5) / samples) * step;
      held[k] += liner(z) * step / samples;
      content[k / parts] += (liner(z) + skirt(z)) / (parts * samples);
    }
  time_ = time;
  oil_.start(content);
  left_ = 0.0;
  if (!covered_) return;
  covered_->start(content);
  std::vector<double> state;
  covered_->save(state);
  for (int k = 0; k < parts * n; ++k) state[1 + k] = held[k];
  for (int c = 0; c < n; ++c) state[state.size() - 1 - c] = 1.0;
  covered_->restore(state.begin(), content);
}

StrokeMarch::Stages StrokeMarch::stages_of(const dynamics::Tableau& A, double dt) const {
  return {A.d * dt,
          {{}, {A.a_10 * dt}, {A.a_20 * dt, A.a_21 * dt}},
          {time_, time_ + A.c_1 * dt, time_ + dt}};
}

double StrokeMarch::stage(int index, double kappa, const std::vector<double>& weights,
                          const Eigen::ArrayXd& h, double time) {
  cells_.set_smooth(h);
  speeds_[index] = conditions_.speed(time);
  FilmStage inner{kappa, conditions_.viscosity,   0.0, 0.5 * speeds_[index],
                  false, conditions_.bulk_modulus};
  inner.cavity = Cavity::kLayer;
  if (running_) inner.profile_before = &oil_.profile();
  travel_ = -kappa * speeds_[index];
  for (size_t j = 0; j < weights.size(); ++j) travel_ -= weights[j] * speeds_[j];
  if (covered_) inner.known = known_ = &covered_->slide(travel_, cells_, inner);
  solves += film_.solve(cells_, oil_.before(film_, weights, known_), inner);
  ++stages;
  return load();
}

void StrokeMarch::finish(int index, double kappa, const std::vector<double>& weights) {
  oil_.finish_stage(film_, index, kappa, weights, known_);
}

void StrokeMarch::accept(double dt) {
  oil_.accept_step();
  left_ += oil_.moved().segment(film_.pad().rim_flow(0), film_.pad().rims().size()).sum();
  if (covered_) covered_->advance(travel_, film_, oil_, oil_.content());
  time_ += dt;
  running_ = true;
}

double StrokeMarch::step(const dynamics::Tableau& method, double dt,
                         const std::function<Eigen::ArrayXd(double)>& gap) {
  const Stages at = stages_of(method, dt);
  speeds_[0] = conditions_.speed(time_);
  double result = 0.0;
  for (int i = 1; i <= 2; ++i) {
    result = stage(i, at.kappa, at.weights[i], gap(at.time[i]), at.time[i]);
    finish(i, at.kappa, at.weights[i]);
  }
  accept(dt);
  return result;
}

double StrokeMarch::load_by_gap() {
  RowMatrix slopes;
  film_.sensitivities(RowMatrix::Ones(film_.grid().size(), 1), slopes);
  double sum = 0.0;
  for (int c = 0; c < film_.grid().size(); ++c)
    if (film_.is_full(c)) sum += slopes(c, 0) * film_.grid().area()[c];
  return sum;
}

double StrokeMarch::step_body(const dynamics::Tableau& method, double dt,
                              const Eigen::ArrayXd& shape, double mass, double force) {
  const Stages at = stages_of(method, dt);
  double velocities[3] = {v, 0.0, 0.0}, rates[3] = {acceleration, 0.0, 0.0}, result = 0.0;
  speeds_[0] = conditions_.speed(time_);
  double here = y;
  for (int i = 1; i <= 2; ++i) {
    double y_before = y, v_before = v;
    for (size_t j = 0; j < at.weights[i].size(); ++j) {
      y_before += at.weights[i][j] * velocities[j];
      v_before += at.weights[i][j] * rates[j];
    }
    here = y_before + at.kappa * (v_before + at.kappa * rates[i - 1]);
    for (int iteration = 0;; ++iteration) {
      if (iteration == 60) throw std::runtime_error("Newton did not converge");
      result = stage(i, at.kappa, at.weights[i], shape - here, at.time[i]);
      const double residual =
          mass * ((here - y_before) / at.kappa - v_before) / at.kappa + result - force;
      const double change = -residual / (mass / (at.kappa * at.kappa) - load_by_gap());
      if (std::abs(change) < 1e-14) break;
      here += change;
    }
    velocities[i] = (here - y_before) / at.kappa;
    rates[i] = (velocities[i] - v_before) / at.kappa;
    finish(i, at.kappa, at.weights[i]);
  }
  accept(dt);
  y = here;
  v = velocities[2];
  acceleration = rates[2];
  return result;
}

double StrokeMarch::oil() const { return (oil_.content() * film_.grid().area()).sum() + left_; }

}  // namespace clatter::film
