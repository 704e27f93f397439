// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/pad.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

/// The entire skirt begins and ends at the pin, where the film is closed.
PadGrid make_grid(const PistonLinerOptions& options, double centre) {
  if (options.span == SkirtSpan::kWhole)
    return PadGrid::uniform(-0.5 * std::numbers::pi, 1.5 * std::numbers::pi, options.cells_around,
                            options.skirt_bottom, options.skirt_top, options.cells_along,
                            options.bore_radius, true);
  return PadGrid::uniform(centre - 0.5 * options.pad_span, centre + 0.5 * options.pad_span,
                          options.cells_around, options.skirt_bottom, options.skirt_top,
                          options.cells_along, options.bore_radius);
}

}  // namespace

Pad::Pad(const ContactModel& model, std::string name, double centre)
    : model_(model), name_(std::move(name)), gap_(model, make_grid(model.options, centre)) {
  const PadGrid& grid = gap_.grid();
  const ContactEffects& on = model.options.effects;
  load_.setZero(grid.size());
  if (on.film) film_.emplace(model, grid, place());
  if (on.asperities) contact_.emplace(model, grid.size());
  if (!on.friction) return;
  friction_.emplace(model.options.friction, grid.size());
  levers_.resize(grid.size(), 3);
  for (int i = 0; i < grid.n_angle(); ++i) {
    const Eigen::Vector2d arm =
        model.bodies.bore_axis + grid.radius() * pad_normal(grid.angle(i)).head<2>();
    for (int j = 0; j < grid.n_axial(); ++j) levers_.row(grid.cell(i, j)) << 1.0, arm.y(), -arm.x();
  }
}

void Pad::start(const PadState& state) {
  gap_.set(state);
  film_->start(gap_, state);
}

void Pad::evaluate(const PadState& state, bool first_step, bool with_tangent) {
  gap_.set(state);
  if (!gap_.value().allFinite())
    throw dynamics::StepRefused(model_.options.name + ": gap is not finite", place());
  gap_.find_directions();
  update_load(state, first_step);
  force_ = gap_.by_y().transpose() * load_.matrix();
  force_ += end_force() * gap_.map().height_by_column();
  if (!with_tangent) return;
  if (model_.damping) gap_.find_rate_directions(state);
  update_tangent();
  if (model_.bodies.crank.is_free()) update_crank_column(state.slide_by_turn);
}

void Pad::update_load(const PadState& state, bool first_step) {
  const double velocity = state.pin.ideal.velocity;
  load_.setZero();
  if (film_) {
    film_->solve(gap_, state, first_step);
    load_ += gap_.area() * film_->pressure();
  }
  if (contact_) {
    contact_->set(gap_, state);
    load_ += gap_.area() * contact_->pressure();
  }
  if (!friction_) return;
  friction_->clear(gap_.cover());
  if (film_) film_->add_friction(gap_, velocity, *friction_);
  if (contact_)
    friction_->add_contact(gap_.grid(), contact_->pressure(), contact_->slope(),
                           contact_->rate_slope(), velocity);
}

void Pad::add_force(Eigen::VectorXd& force) const {
  for (size_t i = 0; i < columns().size(); ++i)
    force[columns()[i]] += force_[static_cast<Eigen::Index>(i)];
  if (friction_) force += model_.axial.slide.transpose() * friction_wrench();
}

void Pad::add_tangent(const std::vector<int>& row, Eigen::MatrixXd& tangent) const {
  for (size_t j = 0; j < columns().size(); ++j)
    for (size_t i = 0; i < columns().size(); ++i)
      tangent(row[columns()[i]], row[columns()[j]]) +=
          tangent_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  if (!model_.bodies.crank.is_free()) return;
  for (size_t i = 0; i < columns().size(); ++i)
    tangent(row[columns()[i]], tangent.cols() - 1) += by_turn_[static_cast<Eigen::Index>(i)];
}

// (F, M_x, M_y) about the pin's centre.
Eigen::Vector3d Pad::friction_wrench() const {
  return levers_.transpose() * friction_->force().matrix();
}

// Derivative of the friction wrench, 3 x k.
Eigen::Matrix3Xd Pad::friction_tangent() const {
  const auto weighted = [this](const Eigen::ArrayXd& slope) {
    return Eigen::MatrixX3d(levers_.array().colwise() * slope);
  };
  Eigen::MatrixX3d rub = gap_.by_y().transpose() * weighted(friction_->gap_slope());
  if (model_.damping) rub += gap_.rate_by_y().transpose() * weighted(friction_->rate_slope());
  if (film_) rub += derivative_.transpose() * weighted(friction_->film_slope());
  if (gap_.cover() != nullptr)
    rub +=
        gap_.map().height_by_column() * (friction_->height_slope().matrix().transpose() * levers_);
  return rub.transpose();
}

void Pad::update_tangent() {
  const Eigen::VectorXd& height = gap_.map().height_by_column();
  if (film_)
    film_->sensitivities(gap_, derivative_);
  else
    derivative_.setZero(gap_.grid().size(), height.size());
  tangent_.setZero(height.size(), height.size());
  if (friction_) {
    const Eigen::Matrix3Xd slide = model_.axial.slide(Eigen::all, columns());
    tangent_.noalias() += slide.transpose() * friction_tangent();
  }
  add_load_tangent();
  if (gap_.cover() != nullptr) add_end_tangent();
  if (!model_.bodies.liner) return;
  // The liner's weights move with the stroke: d2h / (dy_l dz) under load.
  const Eigen::VectorXd cross = gap_.map().slope_transposed(load_.matrix());
  tangent_ += cross * height.transpose() + height * cross.transpose();
}

void Pad::add_load_tangent() {
  const auto add_row = [this](int cell, double factor, const SparseRows& rows) {
    double* row = derivative_.row(cell).data();
    for (SparseRows::InnerIterator entry(rows, cell); entry; ++entry)
      row[entry.index()] += factor * entry.value();
  };
  for (int c = 0; c < gap_.grid().size(); ++c) {
    const double area = gap_.area()[c];
    const bool full = film_ && film_->is_full(c);
    const bool touching = contact_ && contact_->slope()[c] != 0.0;
    if (!full && !touching) continue;  // carries no load
    derivative_.row(c) *= full ? area : 0.0;
    if (touching) add_row(c, area * contact_->slope()[c], gap_.by_y());
    if (touching && model_.damping) add_row(c, area * contact_->rate_slope()[c], gap_.rate_by_y());
    for (SparseRows::InnerIterator entry(gap_.by_y(), c); entry; ++entry)
      tangent_.row(entry.index()) += entry.value() * derivative_.row(c);
  }
}

// What changes with the cover: the load by the height, and the force at the end of the liner.
void Pad::add_end_tangent() {
  const Eigen::VectorXd& height = gap_.map().height_by_column();
  Eigen::ArrayXd load_slope = Eigen::ArrayXd::Zero(gap_.grid().size());
  if (film_) load_slope += gap_.area_slope() * film_->pressure();
  double curve = 0.0;
  if (contact_) {
    const Eigen::ArrayXd by_gap = gap_.area_slope() * contact_->elastic();
    load_slope += gap_.area_slope() * contact_->pressure();
    tangent_ += height * (gap_.by_y().transpose() * by_gap.matrix()).transpose();
    curve = contact_->end_slope(gap_);
  }
  tangent_ += (gap_.by_y().transpose() * load_slope.matrix() + curve * height) * height.transpose();
}

// What the sliding speed U changes of film and friction.
void Pad::update_crank_column(double slide_by_turn) {
  const int n = gap_.grid().size();
  Eigen::ArrayXd by_speed = Eigen::ArrayXd::Zero(n), load = by_speed;  // of the film's x, of load_
  if (film_) film_->speed_sensitivity(by_speed);
  for (int c = 0; c < n; ++c)
    if (film_ && film_->is_full(c)) load[c] = gap_.area()[c] * by_speed[c];
  by_turn_ = slide_by_turn * (gap_.by_y().transpose() * load.matrix());
  if (!friction_) return;
  const Eigen::ArrayXd rub = by_speed * friction_->film_slope() + friction_->speed_slope();
  const Eigen::Vector3d wrench = slide_by_turn * (levers_.transpose() * rub.matrix());
  const Eigen::Matrix3Xd slide = model_.axial.slide(Eigen::all, columns());
  by_turn_ += slide.transpose() * wrench;
}

void Pad::add_power(const Eigen::VectorXd& v, const PinStroke& pin, dynamics::Power& power) const {
  const double stroke_velocity = pin.clock.velocity;
  const Eigen::ArrayXd gap_rate = gap_.rate(v, stroke_velocity);
  if (const Eigen::ArrayXd* walls = gap_.wall_rate())  // what moves the walls works on the load
    power.input -= (load_ * *walls).sum();
  power.input -= ((load_ * gap_.by_height()).sum() + end_force()) * stroke_velocity;
  if (film_) power.lost -= (gap_.area() * film_->pressure() * gap_rate).sum();
  if (contact_) {
    power.stored += contact_->energy(gap_);
    if (gap_.recesses() != nullptr)
      power.input += contact_->groove_force(gap_) * pin.ideal.velocity;
    if (model_.damping) power.lost += contact_->lost(gap_);
  }
  if (!friction_) return;
  const Eigen::Vector3d rub = friction_wrench();
  power.lost -= rub.dot(model_.axial.slide * v) + rub[0] * stroke_velocity;
  power.input -= rub[0] * stroke_velocity;
}

void Pad::add_sums(PadSums& sums) const {
  const PadGrid& grid = gap_.grid();
  const Eigen::ArrayXd& area = gap_.area();
  sums.lowest_gap = std::min(sums.lowest_gap, gap_.lowest());
  sums.lowest_outside = std::min(sums.lowest_outside, gap_.value().minCoeff());
  for (int i = 0; i < grid.n_angle(); ++i) {
    const double across = pad_normal(grid.angle(i)).y();
    for (int j = 0; j < grid.n_axial(); ++j) {
      const double load = load_[grid.cell(i, j)];
      sums.side -= load * across;
      sums.moment += load * across * grid.axial(j);
      sums.moment += load * gap_.by_height()[grid.cell(i, j)] * model_.axial.reaction.y();
    }
  }
  if (film_) {
    const Eigen::ArrayXd &pressure = film_->pressure(), &fill = film_->reynolds().fill();
    sums.film_load += (area * pressure).sum();
    sums.film_peak = std::max(sums.film_peak, pressure.maxCoeff());
    Eigen::ArrayXd space = area * film_->cells().content;
    if (gap_.recesses() != nullptr) space = gap_.carrying().select(space, 0.0).eval();
    sums.oil += (space * fill).sum();
    sums.space += space.sum();
  }
  if (contact_) {
    sums.contact_load += (area * contact_->pressure()).sum();
    sums.contact_peak =
        std::max(sums.contact_peak, (area > 0.0).select(contact_->pressure(), 0.0).maxCoeff());
  }
  if (!friction_) return;
  sums.rubbing += friction_->force().sum();
  sums.moment += levers_.col(1).dot(friction_->force().matrix());
}

PadSnapshot Pad::snapshot() const {
  const PadGrid& grid = gap_.grid();
  const int n_i = grid.n_angle(), n_j = grid.n_axial();
  auto field = [&](const Eigen::ArrayXd& values) {
    return RowMatrix(Eigen::Map<const RowMatrix>(values.data(), n_i, n_j));
  };
  PadSnapshot one;
  one.name = name_;
  one.angle.resize(n_i);
  one.axial.resize(n_j);
  for (int i = 0; i < n_i; ++i) one.angle[i] = grid.angle(i);
  for (int j = 0; j < n_j; ++j) one.axial[j] = grid.axial(j);
  one.gap = field(gap_.value());
  if (film_) {
    one.pressure = field(film_->pressure());
    one.fill = field(film_->reynolds().fill().min(1.0));  // a window holds more than its gap
    if (film_->layer()) {
      one.liner_height = film_->layer()->layer().heights();
      one.liner_oil = film_->layer()->layer().thickness();
    }
  }
  if (contact_) one.contact_pressure = field((gap_.area() > 0.0).select(contact_->pressure(), 0.0));
  return one;
}

}  // namespace clatter::film
