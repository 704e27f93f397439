// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/pad_gap.hpp"

#include <cmath>

namespace clatter::film {
namespace {

// A window is so much deeper than the gap [m]: no layer fills it.
constexpr double kWindowDepth = 1e-3;
// Least thickness in a recess [m]: the surfaces that it interrupts may cross.
constexpr double kLeastGap = 1e-7;

}  // namespace

PadGap::PadGap(const ContactModel& model, const PadGrid& grid)
    : grid_(grid), map_(model.bodies, model.at, grid, model.height_by_y) {
  const PistonLinerOptions& options = model.options;
  for (Eigen::ArrayXd* values : {&value_, &by_height_, &area_slope_}) values->setZero(grid.size());
  area_ = grid.area();
  rest_ = options.clearance + skirt_relief(options.skirt, grid);
  Eigen::ArrayXd slope = Eigen::ArrayXd::Zero(grid.size()), skirt = slope;
  for (const LinerShape& shape : options.skirt_shapes)
    LinerShapeMap(shape, grid).add(0.0, skirt, slope);
  rest_ -= skirt;
  if (!model.recesses.empty()) add_recesses(model.recesses);
  if (options.bore) liner_shapes_.emplace_back(*options.bore, grid);
  for (const LinerShape& shape : options.bore_shapes) liner_shapes_.emplace_back(shape, grid);
  if (!options.scaled_bore.empty() || !options.scaled_skirt.empty()) {
    scaled_.emplace(grid);
    for (const ScaledShape& scaled : options.scaled_bore) scaled_->add_bore(scaled.shape);
    for (const ScaledShape& scaled : options.scaled_skirt) scaled_->add_skirt(scaled.shape);
  }
  if (std::isfinite(options.ends.bottom) || std::isfinite(options.ends.top))
    ends_.emplace(options.ends, grid);
}

void PadGap::add_recesses(const std::vector<Recess>& recesses) {
  for (const Recess& one : recesses) recesses_move_ = recesses_move_ || one.on_liner;
  recess_map_.emplace(recesses, grid_);
  recess_map_->at(0.0, recesses_);
  for (Eigen::Index c = 0; c < rest_.size(); ++c)
    if (recesses_.open(c)) rest_[c] += kWindowDepth;
}

void PadGap::set(const PadState& state) {
  if (ends_) {
    ends_->at(state.height, cover_);
    area_ = grid_.area() * cover_.of_cells(grid_.n_angle());
    area_slope_ = grid_.area() * cover_.share_slope.replicate(grid_.n_angle(), 1);
  }
  value_ = rest_;
  by_height_.setZero();
  for (const LinerShapeMap& shape : liner_shapes_) shape.add(state.height, value_, by_height_);
  if (scaled_) scaled_->add(state.height, state.scales, value_, by_height_);
  map_.move(state.height);
  map_.add(state.y, value_, by_height_);
  if (recess_map_) place_recesses(state.pin.ideal.position);
}

// Grooves of the liner move with the ideal stroke alone: a cell does not change between land and
// groove while a stage is solved.
void PadGap::place_recesses(double position) {
  if (recesses_move_) recess_map_->at(position, recesses_);
  for (Eigen::Index c = 0; c < value_.size(); ++c)
    if (recesses_.covered(c) && value_[c] < kLeastGap) value_[c] = kLeastGap;
}

// At fixed stage: v changes with y / kappa, and the liner's weights move with the stroke.
void PadGap::find_rate_directions(const PadState& state) {
  const double kappa = state.stage.kappa;
  Eigen::ArrayXd turning = by_height_ / kappa;
  map_.add_slope(state.v, turning);
  if (scaled_) turning += scaled_->rate_slope();
  map_.rows(1.0 / kappa, state.height_rate, turning, rate_by_y_);
}

Eigen::ArrayXd PadGap::rate(const Eigen::VectorXd& v, double stroke_velocity) const {
  Eigen::VectorXd picked;
  map_.gather(v, picked);
  Eigen::ArrayXd rate = (by_y_ * picked).array() + by_height_ * stroke_velocity;
  if (scaled_) rate += scaled_->rate();
  return rate;
}

Eigen::Array<bool, Eigen::Dynamic, 1> PadGap::carrying() const {
  if (!recess_map_) return area_ > 0.0;
  return area_ > 0.0 && recesses_.share < 1.0;
}

double PadGap::lowest() const { return carrying().select(value_, INFINITY).minCoeff(); }

}  // namespace clatter::film
