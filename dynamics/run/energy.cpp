// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/energy.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/error.hpp"

namespace clatter::dynamics {

EnergyBalance::EnergyBalance(const System& system, const Tableau& method)
    : system_(system), method_(method) {
  term("modal damping");
  for (const auto& load : system.loads()) load_term_.push_back(term(load.term));
  for (int e = 0; e < system.elements(); ++e) {
    lost_term_.push_back(term(system.element(e).name() + " lost"));
    input_term_.push_back(term(system.element(e).name() + " input"));
  }
  for (int e = 0; e < system.elements(); ++e)
    if (system.element(e).events() > 0) events_term_ = term("events");
  is_loss_.assign(names_.size(), 0);
  if (events_term_) is_loss_[*events_term_] = 1;
  is_loss_[0] = 1;
  for (const size_t lost : lost_term_) is_loss_[lost] = 1;
}

size_t EnergyBalance::term(const std::string& name) {
  const auto [found, is_new] = index_.emplace(name, names_.size());
  if (is_new) names_.push_back(name);
  return found->second;
}

EnergyBalance::Flow EnergyBalance::flow(const StageState& state) const {
  Flow flow;
  flow.powers.assign(names_.size(), 0.0);
  flow.kinetic = 0.5 * state.v.dot(system_.inertia().cwiseProduct(state.v));
  flow.strain = 0.5 * state.eta.dot(system_.omega_squared().cwiseProduct(state.eta));
  const auto& second_order = system_.second_order();
  flow.powers[0] =
      -(state.v.array().square() * system_.damping().array() * second_order.array()).sum();
  for (size_t l = 0; l < system_.loads().size(); ++l) {
    const Load& load = system_.loads()[l];
    const auto v = state.v.segment(system_.mode_offset(load.body), load.direction.size());
    flow.powers[load_term_[l]] += load.value(state.time) * load.direction.dot(v);
  }
  for (int e = 0; e < system_.elements(); ++e) {
    const auto& element = system_.element(e);
    const auto& at = element.coordinates();
    const Power power = element.power(gather(state.y, at), gather(state.v_y, at));
    flow.element += power.stored;
    flow.powers[lost_term_[e]] -= power.lost;
    flow.powers[input_term_[e]] += power.input;
  }
  return flow;
}

void EnergyBalance::stage(int index, const StageState& state) {
  const double before = stages_[0].stored();
  stages_[index] = flow(state);
  time_ = state.time;
  if (index != 0) return;
  if (started_) {
    count_event(stages_[0].stored() - before);
  } else {
    start_from(stages_[0]);
  }
}

/// The impulses of an event changed the energy at once.
void EnergyBalance::count_event(double change) {
  if (events_term_) now_.terms[*events_term_] += change;
  now_.lost -= change;
  now_.exchanged += std::abs(change);
  now_.kinetic = stages_[0].kinetic;
  now_.strain = stages_[0].strain;
  now_.element = stages_[0].element;
  follow_stores();
}

void EnergyBalance::follow_stores() {
  const double stores[] = {now_.kinetic, now_.strain, now_.element};
  for (size_t i = 0; i < std::size(stores); ++i) {
    spans_[i].low = std::min(spans_[i].low, stores[i]);
    spans_[i].high = std::max(spans_[i].high, stores[i]);
  }
}

void EnergyBalance::start_from(const Flow& flow) {
  started_ = true;
  now_.kinetic = flow.kinetic;
  now_.strain = flow.strain;
  now_.element = flow.element;
  reset();
}

std::vector<double> EnergyBalance::save() const {
  std::vector<double> state{stages_[0].kinetic, stages_[0].strain, stages_[0].element};
  state.insert(state.end(), stages_[0].powers.begin(), stages_[0].powers.end());
  return state;
}

void EnergyBalance::restore(const std::vector<double>& state, double time) {
  if (state.size() != 3 + names_.size()) {
    throw InputError("energy balance: the saved state belongs to another scene");
  }
  stages_[0] = {state[0], state[1], state[2], {state.begin() + 3, state.end()}};
  time_ = time;
  start_from(stages_[0]);
}

void EnergyBalance::archive(Archive& archive) {
  for (double* value : {&now_.time, &now_.kinetic, &now_.strain, &now_.element, &now_.lost,
                        &now_.input, &now_.exchanged, &stored_at_start_})
    archive(*value);
  archive(now_.terms);
  for (Span& span : spans_) {
    archive(span.low);
    archive(span.high);
  }
}

void EnergyBalance::reset() {
  now_.time = time_;
  now_.lost = now_.input = now_.exchanged = 0.0;
  now_.terms.assign(names_.size(), 0.0);
  stored_at_start_ = now_.stored();
  const double stores[] = {now_.kinetic, now_.strain, now_.element};
  for (size_t i = 0; i < std::size(stores); ++i) spans_[i] = {stores[i], stores[i]};
}

void EnergyBalance::accept(double dt) {
  const auto& b = method_.b;
  for (size_t k = 0; k < names_.size(); ++k) {
    double work = 0.0;
    for (int i = 0; i <= method_.stages; ++i) work += dt * b[i] * stages_[i].powers[k];
    now_.terms[k] += work;
    const bool loss = is_loss_[k] != 0;
    (loss ? now_.lost : now_.input) += loss ? -work : work;
    now_.exchanged += std::abs(work);
  }
  const Flow& end = stages_[method_.stages];
  now_.kinetic = end.kinetic;
  now_.strain = end.strain;
  now_.element = end.element;
  now_.time = time_;
  follow_stores();
  stages_[0] = end;
}

double EnergyBalance::imbalance() const {
  return now_.stored() - stored_at_start_ - now_.input + now_.lost;
}

double EnergyBalance::exchanged() const {
  double largest = now_.exchanged;
  for (const Span& span : spans_) largest = std::max(largest, span.high - span.low);
  return largest;
}

double EnergyBalance::residue(double least) const {
  const double all = std::max(exchanged(), least);
  return all > 0.0 ? std::abs(imbalance()) / all : 0.0;
}

}  // namespace clatter::dynamics
