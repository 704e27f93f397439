// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/liner_layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

// A free part of a cell that is smaller than this part of it counts as covered: the thickness of
// its oil would be a quotient of rounding errors.
constexpr double kSliver = 1e-11;
// The film of Martin's ring where its pressure ends, 4.895 x 1.2257 h_0, at half of the speed, as a
// layer: 4.894968 x 1.225748 / 4.
constexpr double kRing = 1.5;

// Of one pad; its memory is predicted before it is taken.
constexpr double kMostCells = 1e7;

}  // namespace

double LinerLayerOptions::cells(double row) const {
  return std::ceil((top - bottom) / (cell > 0.0 ? cell : row) - kSliver);
}

double ring_layer(const RingOptions& ring, double viscosity, double speed, double gas_load) {
  return std::max(ring.least,
                  kRing * viscosity * std::abs(speed) * ring.face_radius / (ring.load + gas_load));
}

LinerLayer::LinerLayer(const LinerLayerOptions& options, const PadGrid& pad)
    : options_(options),
      skirt_bottom_(pad.axial_edges()[0]),
      skirt_top_(pad.axial_edges()[pad.n_axial()]) {
  const double length = skirt_top_ - skirt_bottom_,
               wanted = options_.cell > 0.0 ? options_.cell : length / pad.n_axial();
  if (!(options_.top - options_.bottom > length) || !(2.0 * wanted <= length))
    throw InputError(
        fmt::format("oil on the liner: found cells of {:.3g} m from {:.6g} to {:.6g} m, expected "
                    "more than the skirt's length, {:.3g} m, and cells of at most half of it",
                    wanted, options_.bottom, options_.top, length));
  for (const RingOptions& ring : options_.rings)
    if (!(ring.height > skirt_top_) || !(ring.load > 0.0) || !(ring.face_radius > 0.0))
      throw InputError(fmt::format(
          "oil on the liner: found a ring at {:.6g} m of radius {:.3g} m under {:.3g} N/m, "
          "expected it above the skirt's top, {:.6g} m, and both positive",
          ring.height, ring.face_radius, ring.load, skirt_top_));
  const double cells = options_.cells(length / pad.n_axial());
  if (!(cells * pad.n_angle() <= kMostCells))
    throw InputError(fmt::format("oil on the liner: found {:.3g} x {} cells, expected at most {:g}",
                                 cells, pad.n_angle(), kMostCells));
  step_ = (options_.top - options_.bottom) / cells;
  arc_.resize(pad.n_angle());
  for (int i = 0; i < pad.n_angle(); ++i) arc_[i] = pad.arc(i);
  held_.setZero(pad.n_angle(), static_cast<Eigen::Index>(cells));
  for (Eigen::ArrayXd* values : {&owed_below_, &owed_above_, &sum_, &rest_})
    values->setZero(pad.n_angle());
}

double LinerLayer::edge(Side side, double height) const {
  return height + (side == Side::kBelow ? skirt_bottom_ : skirt_top_);
}

int LinerLayer::cell_at(double height) const {
  const double place = std::floor((height - options_.bottom) / step_);
  return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(held_.cols() - 1)));
}

// Free height of a cell on this side of an edge of the pad.
double LinerLayer::free(Side side, double edge, int cell) const {
  const double low = floor_of(cell),
               length = side == Side::kBelow ? edge - low : low + step_ - edge;
  return length < kSliver * step_ ? 0.0 : std::min(length, step_);
}

// The free cell next to an edge; -1: the layer ends there.
int LinerLayer::first_free(Side side, double edge) const {
  const int outward = side == Side::kBelow ? -1 : 1, last = static_cast<int>(held_.cols()) - 1;
  for (int k = cell_at(edge); k >= 0 && k <= last; k += outward)
    if (free(side, edge, k) > 0.0) return k;
  return -1;
}

void LinerLayer::start(double height, double thickness) {
  height_ = height;
  for (int k = 0; k < held_.cols(); ++k)
    held_.col(k) = thickness * (free(Side::kBelow, edge(Side::kBelow, height), k) +
                                free(Side::kAbove, edge(Side::kAbove, height), k));
  owed_below_.setZero();
  owed_above_.setZero();
  balance_ = {};
  balance_.liner = volume();
}

void LinerLayer::meet(double travel, Eigen::ArrayXd& lower, Eigen::ArrayXd& upper) const {
  meet_one(Side::kBelow, travel, lower);
  meet_one(Side::kAbove, travel, upper);
}

void LinerLayer::meet_one(Side side, double travel, Eigen::ArrayXd& thickness) const {
  const double from = edge(side, height_), to = from + travel;
  const bool leads = side == Side::kBelow ? travel < 0.0 : travel > 0.0;
  double swept = 0.0;
  thickness.setZero(held_.rows());
  if (leads) {
    const int a = cell_at(std::min(from, to)), b = cell_at(std::max(from, to));
    for (int k = a; k <= b; ++k) {
      const double before = free(side, from, k), covered = before - free(side, to, k);
      if (before <= 0.0 || covered <= 0.0) continue;
      swept += covered;
      thickness += held_.col(k) * (covered / before);
    }
  }
  const Eigen::ArrayXd& owed = side == Side::kBelow ? owed_below_ : owed_above_;
  if (swept > kSliver * step_) {
    thickness = ((thickness - owed) / swept).max(0.0);
    return;
  }
  const int k = first_free(side, from);
  if (k < 0)
    thickness.setZero();
  else
    thickness = held_.col(k) / free(side, from, k);
}

// `out`: volume per length that the film moved out over this edge [m2].
void LinerLayer::move_edge(Side side, double travel, const Eigen::ArrayXd& out) {
  const double from = edge(side, height_), to = from + travel;
  const bool leads = side == Side::kBelow ? travel < 0.0 : travel > 0.0;
  const int a = cell_at(std::min(from, to)), b = cell_at(std::max(from, to));
  rest_ = out;
  double uncovered = 0.0;
  for (int k = a; k <= b; ++k) {
    const double before = free(side, from, k), after = free(side, to, k);
    if (leads && after < before) {
      if (after == 0.0) {
        rest_ += held_.col(k);
        held_.col(k).setZero();
      } else {
        const double part = (before - after) / before;
        rest_ += held_.col(k) * part;
        held_.col(k) *= 1.0 - part;
      }
    }
    uncovered += std::max(0.0, after - before);
  }
  if (!leads && uncovered > kSliver * step_) {
    for (int k = a; k <= b; ++k) {
      const double grown = free(side, to, k) - free(side, from, k);
      if (grown > 0.0) held_.col(k) += rest_ * (grown / uncovered);
    }
    rest_.setZero();
  }
  put(side, to, rest_);
}

// Adds `rest` [m2] on the free side of an edge, next to it; takes what is negative from there.
void LinerLayer::put(Side side, double edge, Eigen::ArrayXd& rest) {
  Eigen::ArrayXd& owed = side == Side::kBelow ? owed_below_ : owed_above_;
  rest -= owed;
  owed.setZero();
  int k = first_free(side, edge);
  if (k < 0) {  // over the end of the liner
    balance_.ends += arc_sum(rest);
    return;
  }
  const int outward = side == Side::kBelow ? -1 : 1;
  held_.col(k) += rest.max(0.0);
  owed = (-rest).max(0.0);
  for (; (owed > 0.0).any() && k >= 0 && k < held_.cols(); k += outward) {
    sum_ = held_.col(k).min(owed);
    held_.col(k) -= sum_;
    owed -= sum_;
  }
}

// What a ring takes away lies on the part of the cell that it has not passed yet: after the entire
// cell the layer is exactly what the ring leaves, in however many steps it passed.
void LinerLayer::pass_ring(const RingOptions& ring, double travel, double left) {
  const double from = height_ + ring.height, to = from + travel, low = std::min(from, to),
               high = std::max(from, to), skirt = edge(Side::kAbove, height_ + travel);
  if (low >= options_.top || high <= options_.bottom) return;
  for (int k = cell_at(low); k <= cell_at(high); ++k) {
    const double begin = floor_of(k), end = begin + step_,
                 passed = std::min(high, end) - std::max(low, begin),
                 ahead = travel > 0.0 ? end - std::max(from, begin) : std::min(from, end) - begin;
    if (passed <= 0.0 || ahead <= 0.0) continue;
    const double share = passed < ahead * (1.0 - kSliver) ? passed / ahead : 1.0;
    sum_ = (held_.col(k) - left * free(Side::kAbove, skirt, k)).max(0.0) * share;
    held_.col(k) -= sum_;
    balance_.scraped += arc_sum(sum_);
  }
}

void LinerLayer::splash(double dt) {
  const double skirt = edge(Side::kBelow, height_);
  const bool drips = std::isfinite(options_.most);
  if (!(options_.splash > 0.0) && !drips) return;
  for (int k = 0; k <= cell_at(skirt); ++k) {
    const double length = free(Side::kBelow, skirt, k);
    if (length == 0.0) continue;
    sum_ = (options_.splash_thickness * length - held_.col(k))
               .max(0.0)
               .min(options_.splash * dt * length);
    held_.col(k) += sum_;
    balance_.supplied += arc_sum(sum_);
    if (!drips) continue;
    sum_ = (held_.col(k) - options_.most * length).max(0.0);
    held_.col(k) -= sum_;
    balance_.dripped += arc_sum(sum_);
  }
}

void LinerLayer::advance(double dt, double travel, const EdgeVolumes& volumes,
                         const std::vector<double>& left) {
  const double outside = balance_.supplied + balance_.scraped + balance_.dripped;
  move_edge(Side::kBelow, travel, volumes.lower / arc_);
  move_edge(Side::kAbove, travel, volumes.upper / arc_);
  for (size_t r = 0; r < options_.rings.size(); ++r)
    pass_ring(options_.rings[r], travel, left.at(r));
  height_ += travel;
  splash(dt);
  balance_.sides += volumes.sides;
  balance_.ends += volumes.ends;
  balance_.moved += volumes.lower.abs().sum() + volumes.upper.abs().sum() + volumes.sides_moved +
                    volumes.ends_moved +
                    (balance_.supplied + balance_.scraped + balance_.dripped - outside);
  balance_.liner = volume();
}

double LinerLayer::volume() const {
  return arc_sum(held_.rowwise().sum()) - arc_sum(owed_below_ + owed_above_);
}

Eigen::ArrayXXd LinerLayer::thickness() const {
  Eigen::ArrayXXd all = held_;
  for (int k = 0; k < held_.cols(); ++k) {
    const double length = free(Side::kBelow, edge(Side::kBelow, height_), k) +
                          free(Side::kAbove, edge(Side::kAbove, height_), k);
    all.col(k) *= length > 0.0 ? 1.0 / length : 0.0;
  }
  return all;
}

Eigen::VectorXd LinerLayer::heights() const {
  return Eigen::VectorXd::LinSpaced(held_.cols(), options_.bottom + 0.5 * step_,
                                    options_.top - 0.5 * step_);
}

void LinerLayer::save(std::vector<double>& state) const {
  state.insert(state.end(), held_.data(), held_.data() + held_.size());
  for (const Eigen::ArrayXd* values : {&owed_below_, &owed_above_})
    state.insert(state.end(), values->begin(), values->end());
  const OilBalance& b = balance_;
  state.insert(state.end(),
               {height_, b.liner, b.supplied, b.scraped, b.dripped, b.sides, b.ends, b.moved});
}

size_t LinerLayer::saved_size() const {
  return static_cast<size_t>(held_.size() + 2 * arc_.size() + 8);
}

std::vector<double>::const_iterator LinerLayer::restore(std::vector<double>::const_iterator next) {
  std::copy(next, next + held_.size(), held_.data());
  next += held_.size();
  for (Eigen::ArrayXd* values : {&owed_below_, &owed_above_}) {
    std::copy(next, next + values->size(), values->begin());
    next += values->size();
  }
  OilBalance& b = balance_;
  for (double* value :
       {&height_, &b.liner, &b.supplied, &b.scraped, &b.dripped, &b.sides, &b.ends, &b.moved})
    *value = *next++;
  return next;
}

}  // namespace clatter::film
