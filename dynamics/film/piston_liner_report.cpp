// SPDX-License-Identifier: GPL-3.0-or-later
// State, power and reports of the piston-liner contact.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/film/pad_state.hpp"

namespace clatter::film {

void PistonLiner::begin_step(double time) {
  step_begin_ = time;
  for (const auto& pad : pads_)
    if (pad->film) pad->film->oil.begin_step();
}

// z_B is integrated by the tableau as y is, from its exact value at the start of the step. The
// pressure of a full film follows from dh/dt; the difference of two exact gaps would be the rate at
// another instant, and with SDIRK2 the pressure only of first order.
void PistonLiner::find_stroke(const dynamics::Stage& stage, const Eigen::VectorXd& y,
                              const Eigen::VectorXd& v) {
  lead_ = bodies_.crank.lead(stage, y, v);
  const StrokeState start = bodies_.stroke(stage.begin()), now = bodies_.stroke(stage.time),
                    led_to = bodies_.stroke(stage.time + lead_.now.position);
  stroke_ = {start.position + stage.kappa * now.velocity, now.velocity};
  for (size_t j = 0; j < stage.weights.size(); ++j)
    stroke_.position += stage.weights[j] * (j == 0 ? start.velocity : stroke_rates_.at(j));
  const dynamics::Motion<double> ideal{led_to.position, led_to.velocity, led_to.acceleration};
  ideal_ = {stroke_.position + (ideal.position - now.position),
            dynamics::led(ideal, lead_.now).velocity};
  slide_by_turn_ = dynamics::led_by_turn(ideal, lead_).velocity;
}

void PistonLiner::finish_stage(const dynamics::Stage& stage) {
  if (options_.liner_layer) travel_ = travel(stage);
  stroke_rates_.at(stage.index) = stroke_.velocity;
  ideal_rates_.at(stage.index) = ideal_.velocity;
  scales_.finish_stage(stage);
  for (const auto& pad : pads_) {
    if (!pad->film) continue;
    PadFilm& film = *pad->film;
    if (pad->layer) film.oil.volumes(film.reynolds, stage.weights, stage.kappa, pad->layer->moved);
    film.oil.finish_stage(film.reynolds, film.cells.content * pad->area / pad->grid.area(),
                          stage.index, stage.kappa);
  }
}

void PistonLiner::accept_step(double time) {
  running_ = true;
  for (const auto& pad : pads_) {
    if (!pad->film) continue;
    pad->film->oil.accept_step();
    if (pad->layer) accept_layer(*pad, time);
  }
}

dynamics::Power PistonLiner::power(const Eigen::VectorXd&, const Eigen::VectorXd& v) const {
  dynamics::Power power;
  for (const auto& pad : pads_) {
    pad->map.gather(v, pad->v);
    const Eigen::ArrayXd& area = pad->area;
    Eigen::ArrayXd gap_rate =
        (pad->gap_by_y * pad->v).array() + pad->gap_by_height * stroke_.velocity;
    if (pad->scaled) {  // what moves the walls works on the load
      gap_rate += pad->scaled->rate();
      power.input -= (pad->load * pad->scaled->rate()).sum();
    }
    power.input -= ((pad->load * pad->gap_by_height).sum() + end_force(*pad)) * stroke_.velocity;
    if (pad->film) power.lost -= (area * pad->film->pressure() * gap_rate).sum();
    if (asperity_) power.stored += (area * pad->contact_energy).sum();
    if (asperity_ && pad->recesses) power.input += recess_power(*pad);
    if (damping_) power.lost += (area * pad->contact_loss).sum();
    if (!pad->friction) continue;
    const Eigen::Vector3d rub = friction_wrench(*pad);
    power.lost -= rub.dot(axial_.slide * v) + rub[0] * stroke_.velocity;
    power.input -= rub[0] * stroke_.velocity;
  }
  return power;
}

void PistonLiner::record(dynamics::History& history) const {
  double lowest = INFINITY, side = 0.0, moment = 0.0, rubbing = 0.0, film_load = 0.0,
         contact_load = 0.0;
  double film_peak = 0.0, contact_peak = 0.0, oil = 0.0, space = 0.0;
  for (const auto& pad : pads_) {
    const PadGrid& grid = pad->grid;
    lowest = std::min(lowest, lowest_gap(*pad));
    for (int i = 0; i < grid.n_angle(); ++i) {
      const double across = pad_normal(grid.angle(i)).y();
      for (int j = 0; j < grid.n_axial(); ++j) {
        const double load = pad->load[grid.cell(i, j)];
        side -= load * across;
        moment += load * across * grid.axial(j);
        moment += load * pad->gap_by_height[grid.cell(i, j)] * axial_.reaction.y();
      }
    }
    if (pad->film) {
      film_load += (pad->area * pad->film->pressure()).sum();
      film_peak = std::max(film_peak, pad->film->pressure().maxCoeff());
      if (pad->recesses) {
        const Eigen::ArrayXd room =
            pad->carrying().select(pad->area * pad->film->cells.content, 0.0);
        oil += (room * pad->film->reynolds.fill()).sum();
        space += room.sum();
      } else {
        oil += (pad->area * pad->film->cells.content * pad->film->reynolds.fill()).sum();
        space += (pad->area * pad->film->cells.content).sum();
      }
    }
    if (asperity_) {
      contact_load += (pad->area * pad->contact).sum();
      contact_peak = std::max(contact_peak, (pad->area > 0.0).select(pad->contact, 0.0).maxCoeff());
    }
    if (pad->friction) {
      rubbing += pad->friction->force().sum();
      moment += pad->levers.col(1).dot(pad->friction->force().matrix());
    }
  }
  if (std::isinf(lowest))  // all of the skirt is outside the liner
    for (const auto& pad : pads_) lowest = std::min(lowest, pad->gap.minCoeff());
  const double normal = film_load + contact_load;
  history.put("film_min", "m", lowest);
  history.put("side_force", "N", side);
  history.put("side_moment", "N m", moment);
  history.put("friction_force", "N", rubbing);
  history.put("film_pressure_max", "Pa", film_peak);
  history.put("contact_pressure_max", "Pa", contact_peak);
  history.put("asperity_share", "1", normal > 0.0 ? contact_load / normal : 0.0);
  history.put("film_fill", "1", space > 0.0 ? oil / space : 0.0);
  const std::optional<OilBalance> balance = oil_balance();
  if (!balance) return;
  history.put("oil_in_gap", "m3", balance->gap);
  history.put("oil_on_liner", "m3", balance->liner);
  history.put("oil_supplied", "m3", balance->supplied);
  history.put("oil_scraped", "m3", balance->scraped);
  history.put("oil_dripped", "m3", balance->dripped);
  history.put("oil_over_sides", "m3", balance->sides);
  history.put("oil_over_ends", "m3", balance->ends);
  if (has_grooves(options_)) history.put("oil_into_grooves", "m3", balance->grooves);
}

std::vector<double> PistonLiner::save() const {
  std::vector<double> state{running_ ? 1.0 : 0.0};
  for (const auto& pad : pads_) {
    if (pad->film) pad->film->oil.save(state);
    if (!pad->layer) continue;
    state.push_back(pad->layer->first);
    pad->layer->layer.save(state);
    if (has_grooves(options_))
      state.insert(state.end(), {pad->recesses->moved, pad->recesses->moved_sum});
  }
  return state;
}

void PistonLiner::restore(const std::vector<double>& state) {
  size_t expected = 1;
  for (const auto& pad : pads_) {
    if (pad->film) expected += pad->film->oil.saved_size();
    if (pad->layer) expected += 1 + pad->layer->layer.saved_size();
    if (pad->layer && has_grooves(options_)) expected += 2;
  }
  if (state.size() != expected)
    throw InputError(options_.name + ": the saved film state has " + std::to_string(state.size()) +
                     " numbers, expected " + std::to_string(expected));
  running_ = state[0] != 0.0;
  auto next = state.begin() + 1;
  for (const auto& pad : pads_) {
    if (pad->film) next = pad->film->oil.restore(next);
    if (!pad->layer) continue;
    pad->layer->first = *next++;
    next = pad->layer->layer.restore(next);
    if (has_grooves(options_)) {
      pad->recesses->moved = *next++;
      pad->recesses->moved_sum = *next++;
    }
    balance_oil(*pad);
  }
}

long PistonLiner::film_solves() const {
  long solves = 0;
  for (const auto& pad : pads_) solves += pad->film_solves;
  return solves;
}

double PistonLiner::film_residual() const {
  double worst = 0.0;
  for (const auto& pad : pads_)
    if (pad->film) worst = std::max(worst, pad->film->reynolds.residual());
  return worst;
}

std::vector<PadSnapshot> PistonLiner::snapshot() const {
  std::vector<PadSnapshot> all;
  for (const auto& pad : pads_) {
    const int n_i = pad->grid.n_angle(), n_j = pad->grid.n_axial();
    auto field = [&](const Eigen::ArrayXd& values) {
      return RowMatrix(Eigen::Map<const RowMatrix>(values.data(), n_i, n_j));
    };
    PadSnapshot one;
    one.name = pad->name;
    one.angle.resize(n_i);
    one.axial.resize(n_j);
    for (int i = 0; i < n_i; ++i) one.angle[i] = pad->grid.angle(i);
    for (int j = 0; j < n_j; ++j) one.axial[j] = pad->grid.axial(j);
    one.gap = field(pad->gap);
    if (pad->film) {
      one.pressure = field(pad->film->pressure());
      one.fill = field(pad->film->reynolds.fill().min(1.0));  // a window holds more than its gap
    }
    if (asperity_) one.contact_pressure = field((pad->area > 0.0).select(pad->contact, 0.0));
    if (pad->layer) {
      one.liner_height = pad->layer->layer.heights();
      one.liner_oil = pad->layer->layer.thickness();
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace clatter::film
