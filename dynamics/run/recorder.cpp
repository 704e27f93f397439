// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/recorder.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {
UniformSamples::UniformSamples(double begin, double end, double step, int modes) : begin_(begin) {
  const int n = std::max(1, static_cast<int>(std::lround((end - begin) / step)));
  step_ = (end - begin) / n;
  eta_ = v_ = a_ = RowMatrix::Zero(n + 1, modes);
}

double UniformSamples::time(int i) const { return begin_ + step_ * i; }

void UniformSamples::start(const StageState& state) {
  eta_.row(0) = state.eta;
  v_.row(0) = state.v;
  a_.row(0) = state.a;
  v_half_ = state.v;
  count_ = 1;
}

void UniformSamples::take(const StageState& p, const StageState& n, double t) {
  const double h = n.time - p.time, s = std::clamp((t - p.time) / h, 0.0, 1.0);
  const Eigen::VectorXd v = hermite(p.v, p.a, n.v, n.a, h, s);
  if (++halves_ % 2 == 0) {
    eta_.row(count_) = hermite(p.eta, p.v, n.eta, n.v, h, s);
    v_.row(count_) = v;
    a_.row(count_) = (v - v_half_) / (0.5 * step_);  // until the interval is complete
    ++count_;
    return;
  }
  const int last = count_ - 1;
  a_.row(last) = (v - v_half_) / (last == 0 ? 0.5 * step_ : step_);
  v_half_ = v;
}

void UniformSamples::add(const StageState& previous, const StageState& now) {
  // The last sample is at the end itself and must not be lost by rounding.
  const double half = 0.5 * step_, slack = 1e-6 * step_;
  const auto next = [&] { return begin_ + half * (halves_ + 1); };
  while (count_ < eta_.rows() && next() <= now.time + slack) take(previous, now, next());
}

Recorder::Recorder(const Model& model, double begin, double end, double step, double film_every)
    : samples_(begin, end, step, model.system.modes()),
      film_every_(model.contact != nullptr ? film_every : 0.0),
      next_film_(begin) {}

void Recorder::append(Columns& columns, const History& row) {
  const auto& entries = row.entries();
  if (columns.names.empty()) {
    columns.values.resize(entries.size());
    for (const auto& entry : entries) {
      columns.names.push_back(entry.name);
      columns.units.push_back(entry.unit);
    }
  }
  for (size_t i = 0; i < entries.size(); ++i) columns.values[i].push_back(entries[i].value);
}

void Recorder::record(const Model& model, const StageState& previous, const StageState& now,
                      const EnergyBalance& energy) {
  samples_.add(previous, now);
  time_.push_back(now.time);
  History row;
  model.record(now, row);
  append(history_, row);
  row.clear();
  const EnergyState& e = energy.now();
  row.put("kinetic", "J", e.kinetic);
  row.put("strain", "J", e.strain);
  row.put("element", "J", e.element);
  row.put("input", "J", e.input);
  row.put("lost", "J", e.lost);
  row.put("imbalance", "J", energy.imbalance());
  for (const auto& [name, work] : e.terms) row.put("terms/" + name, "J", work);
  append(energy_, row);
  if (film_every_ > 0.0 && now.time >= next_film_) {
    film_.time.push_back(now.time);
    film_.pads.push_back(model.contact->snapshot());
    while (next_film_ <= now.time) next_film_ += film_every_;
  }
}

}  // namespace clatter::dynamics
