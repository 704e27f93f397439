// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/piston_liner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "dynamics/film/pad.hpp"

namespace clatter::film {

PistonLiner::~PistonLiner() = default;

PistonLiner::PistonLiner(PistonLinerOptions options, PistonLinerBodies bodies,
                         std::vector<int> coordinates)
    : ForceElement(std::move(coordinates)),
      model_(std::move(options), std::move(bodies), static_cast<int>(coordinates_.size())),
      stroke_(model_.bodies.stroke, model_.bodies.crank) {
  model_.bodies.crank.join(coordinates_);
  touched_row_.assign(coordinates_.size(), -1);
  for (const auto* shapes : {&model_.options.scaled_bore, &model_.options.scaled_skirt})
    for (const ScaledShape& shape : *shapes) scales_.add(shape.scale);
  if (model_.options.span == SkirtSpan::kWhole) {
    pads_.push_back(std::make_unique<Pad>(model_, "skirt", 0.0));
  } else {
    pads_.push_back(std::make_unique<Pad>(model_, "thrust", 0.0));
    pads_.push_back(std::make_unique<Pad>(model_, "antithrust", std::numbers::pi));
  }
  check_recesses();
}

void PistonLiner::check_recesses() const {
  const PistonLinerOptions& options = model_.options;
  const double row = (options.skirt_top - options.skirt_bottom) / options.cells_along;
  for (size_t k = 0; k < options.recesses.size(); ++k) {
    const Recess& one = options.recesses[k];
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}: recess {}: {}", options.name, k + 1, what));
    };
    if (!(one.pressure >= 0.0)) fail(fmt::format("found {} Pa, expected >= 0", one.pressure));
    if (!(one.fill >= 0.0 && one.fill <= 1.0))
      fail(fmt::format("found a fill of {}, expected 0 to 1", one.fill));
    if (one.pressure > 0.0 && one.fill < 1.0)
      fail(fmt::format("found a fill of {} under pressure, expected 1", one.fill));
    if (one.kind == Recess::Kind::kWindow && one.on_liner)
      fail("found a window of the liner, expected a groove: with fill 0 for a port");
    if (one.on_liner && !(one.top - one.bottom >= row))
      fail(fmt::format("found a height of {:.4g} m, expected at least a row of cells, {:.4g} m",
                       one.top - one.bottom, row));
    int cells = 0;
    for (const auto& pad : pads_) cells += pad->gap().cells_of_recess(k);
    if (cells == 0)
      fail("the recess covers no cell: it is smaller than a cell or outside the pads");
  }
}

void PistonLiner::begin_step(double time) {
  step_begin_ = time;
  for (const auto& pad : pads_)
    if (pad->film()) pad->film()->begin_step();
}

void PistonLiner::evaluate(const dynamics::Stage& stage, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& v, bool with_tangent,
                           dynamics::Response& response) {
  stroke_.find(stage, y, v);
  const dynamics::CrankLead& lead = stroke_.lead();
  if (!scales_.empty()) scaled_ = scales_.at(stage, lead);
  const PinStroke& pin = stroke_.now();
  const double travel = stroke_.travel(stage);
  const PadState now{stage,
                     pin,
                     stroke_.slide_by_turn(),
                     model_.height(pin.clock.position, y),
                     model_.height(pin.clock.velocity, v),
                     travel,
                     scaled_,
                     y,
                     v};
  if (!running_ && model_.options.effects.film) {  // from the start, y~ = y - kappa v
    const double begin = stage.time - stage.kappa;
    const PinStroke first = stroke_.exact(begin, lead.begin);
    const Eigen::VectorXd y_begin = y - stage.kappa * v;
    const std::vector<ScaleState> scales = scales_.exact(begin, lead.begin);
    const PadState start{stage, first, 0.0,    model_.height(first.clock.position, y_begin),
                         0.0,   0.0,   scales, y_begin,
                         v};
    for (const auto& pad : pads_) pad->start(start);
  }
  parallel_tasks(static_cast<int>(pads_.size()),
                 [&](int k) { pads_[k]->evaluate(now, !running_, with_tangent); });
  response.force.setZero(std::ssize(coordinates_));
  for (const auto& pad : pads_) pad->add_force(response.force);
  list_touched(response);
  if (!with_tangent) return;
  response.tangent.setZero(touched_count_, touched_count_);
  for (const auto& pad : pads_) pad->add_tangent(touched_row_, response.tangent);
}

// The coordinates of both pads and the crank's, ascending; none where they are all.
void PistonLiner::list_touched(dynamics::Response& response) {
  std::fill(touched_row_.begin(), touched_row_.end(), -1);
  for (const auto& pad : pads_)
    for (const int column : pad->columns()) touched_row_[column] = 0;
  response.touched.clear();
  if (model_.bodies.crank.is_free()) touched_row_.back() = 0;
  const auto count = static_cast<int>(coordinates_.size());
  for (int i = 0; i < count; ++i) {
    int& row = touched_row_[i];
    if (row < 0) continue;
    row = static_cast<int>(response.touched.size());
    response.touched.push_back(i);
  }
  touched_count_ = static_cast<int>(response.touched.size());
  if (touched_count_ == count) response.touched.clear();
}

void PistonLiner::finish_stage(const dynamics::Stage& stage) {
  travel_ = stroke_.travel(stage);
  stroke_.finish_stage(stage);
  scales_.finish_stage(stage);
  for (const auto& pad : pads_)
    if (pad->film()) pad->film()->finish_stage(stage);
}

void PistonLiner::accept_step(double time) {
  running_ = true;
  std::vector<double> left;  // by the rings
  if (model_.options.liner_layer) {
    const dynamics::Motion<double>& lead = stroke_.lead().now;
    const StrokeState pin = stroke_.exact(time, lead).ideal;
    for (const RingOptions& ring : model_.options.liner_layer->rings)
      left.push_back(ring_layer(ring, model_.viscosity->at_height(pin.position + ring.height),
                                pin.velocity,
                                ring.gas_load ? ring.gas_load(time + lead.position) : 0.0));
  }
  for (const auto& pad : pads_)
    if (pad->film()) pad->film()->accept_step(time - step_begin_, travel_, left);
}

dynamics::Power PistonLiner::power(const Eigen::VectorXd&, const Eigen::VectorXd& v) const {
  dynamics::Power power;
  for (const auto& pad : pads_) pad->add_power(v, stroke_.now(), power);
  return power;
}

void PistonLiner::record(dynamics::History& history) const {
  PadSums sums;
  for (const auto& pad : pads_) pad->add_sums(sums);
  const double normal = sums.film_load + sums.contact_load;
  // All of the skirt may be outside the liner.
  history.put("film_min", "m", std::isinf(sums.lowest_gap) ? sums.lowest_outside : sums.lowest_gap);
  history.put("side_force", "N", sums.side);
  history.put("side_moment", "N m", sums.moment);
  history.put("friction_force", "N", sums.rubbing);
  history.put("film_pressure_max", "Pa", sums.film_peak);
  history.put("contact_pressure_max", "Pa", sums.contact_peak);
  history.put("asperity_share", "1", normal > 0.0 ? sums.contact_load / normal : 0.0);
  history.put("film_fill", "1", sums.space > 0.0 ? sums.oil / sums.space : 0.0);
  record_oil(history);
}

void PistonLiner::record_oil(dynamics::History& history) const {
  const std::optional<OilBalance> balance = oil_balance();
  if (!balance) return;
  history.put("oil_in_gap", "m3", balance->gap);
  history.put("oil_on_liner", "m3", balance->liner);
  history.put("oil_supplied", "m3", balance->supplied);
  history.put("oil_scraped", "m3", balance->scraped);
  history.put("oil_dripped", "m3", balance->dripped);
  history.put("oil_over_sides", "m3", balance->sides);
  history.put("oil_over_ends", "m3", balance->ends);
  if (has_grooves(model_.options.recesses)) history.put("oil_into_grooves", "m3", balance->grooves);
}

std::vector<double> PistonLiner::save() const {
  std::vector<double> state{running_ ? 1.0 : 0.0};
  for (const auto& pad : pads_)
    if (pad->film()) pad->film()->save(state);
  return state;
}

void PistonLiner::restore(const std::vector<double>& state) {
  size_t expected = 1;
  for (const auto& pad : pads_)
    if (pad->film()) expected += pad->film()->saved_size();
  if (state.size() != expected)
    throw InputError(name() + ": the saved film state has " + std::to_string(state.size()) +
                     " numbers, expected " + std::to_string(expected));
  running_ = state[0] != 0.0;
  auto next = state.begin() + 1;
  for (const auto& pad : pads_)
    if (pad->film()) next = pad->film()->restore(next);
}

std::vector<PadSnapshot> PistonLiner::snapshot() const {
  std::vector<PadSnapshot> all;
  for (const auto& pad : pads_) all.push_back(pad->snapshot());
  return all;
}

long PistonLiner::film_solves() const {
  long solves = 0;
  for (const auto& pad : pads_)
    if (pad->film()) solves += pad->film()->solves();
  return solves;
}

double PistonLiner::film_residual() const {
  double worst = 0.0;
  for (const auto& pad : pads_)
    if (pad->film()) worst = std::max(worst, pad->film()->reynolds().residual());
  return worst;
}

std::optional<OilBalance> PistonLiner::oil_balance() const {
  if (!model_.options.liner_layer) return std::nullopt;
  OilBalance sum;
  for (const auto& pad : pads_) sum += pad->film()->layer()->balance();
  return sum;
}

}  // namespace clatter::film
