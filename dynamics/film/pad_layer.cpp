// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/pad_layer.hpp"

namespace clatter::film {

void PadLayer::start(double height, double thickness, double in_gap) {
  layer_.start(height, thickness);
  first_ = layer_.volume() + in_gap;
}

const OutsideLayers& PadLayer::meet(double travel) {
  layer_.meet(travel, outside_.begin, outside_.end);
  return outside_;
}

void PadLayer::advance(const PadFaces& pad, double dt, double travel, const Eigen::ArrayXd& moved,
                       const std::vector<double>& left, double in_gap) {
  pad.add_up_edges(moved, volumes_);
  into_grooves_ += volumes_.recesses;
  moved_by_grooves_ += volumes_.recesses_moved;
  layer_.advance(dt, travel, volumes_, left);
  balance(in_gap);
}

void PadLayer::balance(double in_gap) {
  balance_ = layer_.balance();
  balance_.gap = in_gap;
  balance_.first = first_;
  balance_.grooves = into_grooves_;
  balance_.moved += moved_by_grooves_;
}

void PadLayer::save(std::vector<double>& state) const {
  state.push_back(first_);
  layer_.save(state);
  if (has_grooves_) state.insert(state.end(), {into_grooves_, moved_by_grooves_});
}

std::vector<double>::const_iterator PadLayer::restore(std::vector<double>::const_iterator next,
                                                      double in_gap) {
  first_ = *next++;
  next = layer_.restore(next);
  if (has_grooves_) {
    into_grooves_ = *next++;
    moved_by_grooves_ = *next++;
  }
  balance(in_gap);
  return next;
}

}  // namespace clatter::film
