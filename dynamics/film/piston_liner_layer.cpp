// SPDX-License-Identifier: GPL-3.0-or-later
// The piston-liner contact and the layer of oil on the liner.
#include "dynamics/film/pad_state.hpp"

namespace clatter::film {

// From the start of the step to this stage, as the film's speed has it.
double PistonLiner::travel(const dynamics::Stage& stage) const {
  const double start =
      bodies_.stroke(stage.begin() + lead_.begin.position).velocity * (1.0 + lead_.begin.velocity);
  double sum = stage.kappa * ideal_.velocity;
  for (size_t j = 0; j < stage.weights.size(); ++j)
    sum += stage.weights[j] * (j == 0 ? start : ideal_rates_.at(j));
  return sum;
}

void PistonLiner::meet_layer(Pad& pad, const dynamics::Stage& stage) {
  PadLayer& on_liner = *pad.layer;
  on_liner.layer.meet(travel(stage), on_liner.lower, on_liner.upper);
  pad.film->reynolds.set_outside_layers(on_liner.lower, on_liner.upper);
}

void PistonLiner::accept_layer(Pad& pad, double time) {
  PadLayer& on_liner = *pad.layer;
  const double at_crank = time + lead_.now.position;
  const StrokeState stroke = bodies_.stroke(at_crank);
  const double speed = stroke.velocity * (1.0 + lead_.now.velocity);
  std::vector<double> left;
  for (const RingOptions& ring : options_.liner_layer->rings)
    left.push_back(ring_layer(ring, viscosity_->at_height(stroke.position + ring.height), speed,
                              ring.gas_load ? ring.gas_load(at_crank) : 0.0));
  pad.film->reynolds.add_up_edges(on_liner.moved, on_liner.volumes);
  if (has_grooves(options_)) {
    pad.recesses->moved += on_liner.volumes.recesses;
    pad.recesses->moved_sum += on_liner.volumes.recesses_moved;
  }
  on_liner.layer.advance(time - step_begin_, travel_, on_liner.volumes, left);
  balance_oil(pad);
}

void PistonLiner::balance_oil(Pad& pad) {
  PadLayer& on_liner = *pad.layer;
  on_liner.balance = on_liner.layer.balance();
  on_liner.balance.gap = (pad.film->oil.content() * pad.grid.area()).sum();
  on_liner.balance.first = on_liner.first;
  if (!pad.recesses) return;
  on_liner.balance.grooves = pad.recesses->moved;
  on_liner.balance.moved += pad.recesses->moved_sum;
}

std::optional<OilBalance> PistonLiner::oil_balance() const {
  if (!options_.liner_layer) return std::nullopt;
  OilBalance sum;
  for (const auto& pad : pads_) sum += pad->layer->balance;
  return sum;
}

}  // namespace clatter::film
