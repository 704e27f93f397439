// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/bearing/journal_film.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

/// From the groove once around to the groove; the grid's angles count from +y, a quarter of a turn
/// before +z.
film::PadGrid grid_of(const JournalFilmOptions& o) {
  const double begin = o.groove + 0.5 * std::numbers::pi;
  return film::PadGrid::uniform(begin, begin + 2.0 * std::numbers::pi, o.cells_around, 0.0,
                                0.5 * o.size.width, o.cells_along, 0.5 * o.size.diameter);
}

/// The first axial edge is the plane of symmetry.
film::Edges edges_of(const JournalFilmOptions& o) {
  const film::Edge groove = film::Edge::supply(o.supply_pressure, 1.0);
  return {groove, groove, film::Edge::wall(), film::Edge::supply(0.0, 1.0)};
}

}  // namespace

JournalFilm::JournalFilm(const JournalFilmOptions& options)
    : options_(options),
      reynolds_(grid_of(options), edges_of(options), options.cavitation),
      oil_(reynolds_) {
  const film::PadGrid& grid = reynolds_.grid();
  area_ = 2.0 * grid.area();
  normal_.resize(grid.size(), 2);
  for (int i = 0; i < grid.n_angle(); ++i)
    for (int j = 0; j < grid.n_axial(); ++j)
      normal_.row(grid.cell(i, j)) << std::cos(grid.angle(i)), std::sin(grid.angle(i));
  directions_ = -normal_;
}

void JournalFilm::set_gap(const Eigen::Vector2d& offset) {
  gap_ = options_.size.radial_clearance() - (normal_ * offset).array();
  cells_.set_smooth(gap_);
}

FilmForce JournalFilm::force(const JournalMotion& motion, const Stage& stage,
                             bool with_derivatives) {
  const BearingSize& size = options_.size;
  const double found = motion.offset.norm() / size.radial_clearance();
  if (!(found < BearingFilm::kLargest))
    throw StepRefused("the journal touches the bearing",
                      fmt::format("relative eccentricity {:.6g}", found));
  if (!running_) {
    set_gap(motion.offset - stage.kappa * motion.velocity);
    oil_.start(gap_);
  }
  set_gap(motion.offset);
  const double radius = 0.5 * size.diameter;
  film::FilmStage inner{stage.kappa, size.viscosity, 0.5 * radius * motion.spin,
                        0.0,         false,          options_.bulk_modulus};
  if (running_) inner.profile_before = &oil_.profile();
  try {
    reynolds_.solve(cells_, oil_.before(reynolds_, stage.weights), inner);
  } catch (const NumericsError& error) {
    throw StepRefused("the film's equations were not solved", error.what());
  }
  FilmForce law;
  law.by_motion.setZero();
  const Eigen::VectorXd load = area_ * reynolds_.pressure();
  law.value.head<2>() = -(normal_.transpose() * load);
  Eigen::ArrayXd sheared(gap_.size()), by_fill(gap_.size());
  for (int cell = 0; cell < gap_.size(); ++cell) {
    const film::ValueSlope fraction = reynolds_.sheared(cell);
    sheared(cell) = fraction.value;
    by_fill(cell) = reynolds_.is_full(cell) ? 0.0 : fraction.slope;
  }
  const double shear = size.viscosity * radius * radius;
  const double couette = -shear * (area_ * sheared / gap_).sum();
  const Eigen::Vector2d &e = motion.offset, F = law.value.head<2>();
  law.value(2) = couette * motion.spin - 0.5 * (e.x() * F.y() - e.y() * F.x());
  if (!with_derivatives) return law;
  reynolds_.sensitivities(directions_, derivative_);
  Eigen::Matrix2d by_offset = Eigen::Matrix2d::Zero();
  Eigen::RowVector2d rub = Eigen::RowVector2d::Zero();
  for (int cell = 0; cell < gap_.size(); ++cell) {
    if (reynolds_.is_full(cell))
      by_offset -= area_(cell) * normal_.row(cell).transpose() * derivative_.row(cell);
    rub += area_(cell) / gap_(cell) *
           (by_fill(cell) * derivative_.row(cell) + sheared(cell) / gap_(cell) * normal_.row(cell));
  }
  law.by_motion.topLeftCorner<2, 2>() = by_offset;
  law.by_motion.row(2).head<2>() =
      -shear * motion.spin * rub - 0.5 * (Eigen::RowVector2d(F.y(), -F.x()) +
                                          e.x() * by_offset.row(1) - e.y() * by_offset.row(0));
  law.by_motion(2, 4) = couette;
  return law;
}

void JournalFilm::finish_stage(const Stage& stage) {
  oil_.finish_stage(reynolds_, stage.index, stage.kappa, stage.weights);
}

void JournalFilm::accept_step() {
  oil_.accept_step();
  running_ = true;
}

std::vector<double> JournalFilm::save() const {
  std::vector<double> state;
  state.reserve(oil_.saved_size());
  oil_.save(state);
  return state;
}

void JournalFilm::restore(const std::vector<double>& state) {
  if (state.size() != oil_.saved_size())
    throw InputError(fmt::format("film of a bearing: found {} numbers, expected {}", state.size(),
                                 oil_.saved_size()));
  oil_.restore(state.begin());
  running_ = true;
}

}  // namespace clatter::dynamics
