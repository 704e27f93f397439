// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/reynolds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/film/balance_slopes.hpp"

namespace clatter::film {
namespace {

// Solves for each cell along the two sides of a grid, and for the smallest grids. A boundary of the
// full film that moves by one cell in each solve crosses the grid in one.
constexpr int kSolvesPerCell = 10;
constexpr int kLeastSolves = 200;

}  // namespace

Reynolds::Reynolds(const PadGrid& grid, const Edges& edges, bool cavitation, bool reservoirs)
    : cavitation_(cavitation),
      terms_(PadFaces(grid, edges, reservoirs)),
      split_(terms_.pad()),
      lu_(grid.size(), terms_.pad().band()) {
  const int n = grid.size();
  x_.setZero(n);
  fill_.setOnes(n);
  for (Eigen::ArrayXd* values : {&pressure_, &balance_, &magnitude_}) values->setZero(n);
  flows_.setZero(terms_.pad().flow_count());
  carried_.setZero(terms_.pad().flow_count());
}

int Reynolds::solve(const FilmCells& film, const Eigen::ArrayXd& content_before,
                    const FilmStage& stage) {
  terms_.set(film, content_before, stage);
  if (cavitation_) split_.guess(terms_, fill_);
  const int limit = kLeastSolves + kSolvesPerCell * (grid().n_angle() + grid().n_axial());
  for (int iteration = 1; iteration <= limit; ++iteration) {
    assemble();
    if (!lu_.factor())
      throw NumericsError("film: singular Reynolds matrix: a cell has neither storage nor flow");
    lu_.solve(x_.data());
    if (!x_.allFinite()) throw NumericsError("film: the Reynolds solution is not finite");
    if (!cavitation_ || !split_.update(terms_, x_)) {
      unpack();
      measure();
      return iteration;
    }
  }
  split_.forget();
  throw NumericsError(
      fmt::format("film: no split into full and cavitated cells found in {} solves", limit));
}

// The row of a cell outside the liner or in a groove holds only what is given.
void Reynolds::add(int cell, int unknown, double value) {
  if (!terms_.extent().is_given(cell))
    lu_.at(terms_.pad().row(cell), terms_.pad().row(unknown)) += value;
}

void Reynolds::give(int cell, double value) {
  if (!terms_.extent().is_given(cell)) x_[terms_.pad().row(cell)] += value;
}

void Reynolds::assemble() {
  lu_.set_zero();
  assemble_cells();
  assemble_flows();
  if (terms_.pad().grooves()) assemble_grooves();
  if (terms_.extent().partial()) assemble_ends();
}

void Reynolds::assemble_cells() {
  const FilmExtent& extent = terms_.extent();
  const double pressure_scale = terms_.pressure_scale();
  for (int c = 0; c < grid().size(); ++c) {
    const bool full = is_full(c);
    const int row = terms_.pad().row(c);
    if (!extent.is_given(c)) {
      x_[row] = terms_.before()[c];
      if (full) x_[row] -= terms_.storage()[c];
      lu_.at(row, row) += full ? terms_.squeeze()[c] : terms_.storage()[c];
      continue;
    }
    const RecessCells* recesses = terms_.stage().recesses;
    x_[row] = extent.is(CellKind::kOutside, c) ? terms_.pad().liner_end().pressure / pressure_scale
              : full                           ? recesses->pressure[c] / pressure_scale
                                               : recesses->fill[c];
    lu_.at(row, row) = 1.0;
  }
}

void Reynolds::assemble_flows() {
  for (size_t f = 0; f < terms_.faces().size(); ++f) {
    const FaceTerms& face = terms_.faces()[f];
    const int a = face.a, b = face.b, upstream = face.upstream();
    if (is_full(a)) {
      add(a, a, face.conduct);
      add(b, a, -face.conduct);
    }
    if (is_full(b)) {
      add(b, b, face.conduct);
      add(a, b, -face.conduct);
    }
    const FillLaw law = split_.on_face(terms_, f);
    const double lifted = face.carry * law.empty, rest = face.carry * law.full - lifted;
    give(a, -lifted);
    give(b, lifted);
    if (is_full(upstream)) continue;
    add(a, upstream, rest);
    add(b, upstream, -rest);
  }
  for (size_t r = 0; r < terms_.rims().size(); ++r) {
    const RimTerms& rim = terms_.rims()[r];
    const int c = rim.cell;
    give(c, rim.conduct * rim.pressure / terms_.pressure_scale());
    if (is_full(c)) add(c, c, rim.conduct);
    if (rim.carry > 0.0) {
      const FillLaw law = split_.on_rim(terms_, r);
      give(c, -(rim.carry * law.empty));
      add(c, c, rim.carry * (law.full - law.empty));
    } else {
      give(c, -rim.entering);
    }
  }
}

void Reynolds::assemble_grooves() {
  for (int c = 0; c < grid().size(); ++c) {
    const double exchange = terms_.exchange(c);
    if (exchange == 0.0) continue;
    give(c, exchange * terms_.stage().recesses->pressure[c] / terms_.pressure_scale());
    if (is_full(c)) add(c, c, exchange);
  }
}

void Reynolds::assemble_ends() {
  for (int c = 0; c < grid().size(); ++c) {
    const double covered = terms_.covered(c), area = std::abs(covered);
    if (covered == 0.0) continue;
    const FillLaw law = split_.at_end(terms_, c);
    give(c, -area * (is_full(c) ? law.full : law.empty));
    if (!is_full(c))
      add(c, c, area * (law.full - law.empty));
    else if (covered < 0.0 && terms_.compressible())
      add(c, c,
          area * terms_.film().content[c] * terms_.pressure_scale() / terms_.stage().bulk_modulus);
  }
}

void Reynolds::unpack() {
  const FilmExtent& extent = terms_.extent();
  for (int c = 0; c < grid().size(); ++c) {
    const double value = x_[terms_.pad().row(c)];
    const bool full = is_full(c);
    pressure_[c] =
        full ? (cavitation_ ? std::max(value, 0.0) : value) * terms_.pressure_scale() : 0.0;
    // Beyond the bounds by rounding; a window holds more than its own gap.
    fill_[c] = extent.is(CellKind::kOutside, c) ? 0.0
               : full                           ? 1.0
                      : std::clamp(value, 0.0, extent.is(CellKind::kWindow, c) ? INFINITY : 1.0);
  }
}

// Balance of each cell with the returned values, relative to its own terms.
void Reynolds::measure() {
  const double pressure_scale = terms_.pressure_scale();
  balance_ =
      terms_.storage() * fill_ + terms_.squeeze() * pressure_ / pressure_scale - terms_.before();
  magnitude_ = terms_.storage() * fill_.abs() + terms_.before().abs();
  const double flow_scale = terms_.volume_scale() / terms_.stage().duration();
  for (size_t f = 0; f < terms_.faces().size(); ++f) {
    const FaceTerms& face = terms_.faces()[f];
    const int a = face.a, b = face.b;
    const double carried = face.carry * split_.on_face(terms_, f).at(fill_[face.upstream()]);
    const double flow = face.conduct * (pressure_[a] - pressure_[b]) / pressure_scale + carried;
    const double size =
        face.conduct * (std::abs(pressure_[a]) + std::abs(pressure_[b])) / pressure_scale +
        std::abs(carried);
    flows_[PadFaces::face_flow(f)] = flow * flow_scale;
    carried_[PadFaces::face_flow(f)] = carried * flow_scale;
    balance_[a] += flow;
    balance_[b] -= flow;
    magnitude_[a] += size;
    magnitude_[b] += size;
  }
  outflow_ = 0.0;
  for (size_t r = 0; r < terms_.rims().size(); ++r) {
    const RimTerms& rim = terms_.rims()[r];
    const int c = rim.cell;
    const double carried =
        rim.carry > 0.0 ? rim.carry * split_.on_rim(terms_, r).at(fill_[c]) : rim.entering;
    const double flow = rim.conduct * (pressure_[c] - rim.pressure) / pressure_scale + carried;
    balance_[c] += flow;
    magnitude_[c] +=
        rim.conduct * (std::abs(pressure_[c]) + rim.pressure) / pressure_scale + std::abs(carried);
    flows_[terms_.pad().rim_flow(r)] = flow * flow_scale;
    carried_[terms_.pad().rim_flow(r)] = carried * flow_scale;
    outflow_ += flow;
  }
  residual_ = 0.0;
  for (int c = 0; c < grid().size(); ++c) measure_cell(c, flow_scale);
  outflow_ *= terms_.volume_scale();
}

// The flows out of a cell that no other cell takes, and its residual.
void Reynolds::measure_cell(int cell, double flow_scale) {
  const PadFaces& pad = terms_.pad();
  const FilmExtent& extent = terms_.extent();
  double over_end = extent.partial()
                        ? std::abs(terms_.covered(cell)) *
                              split_.end_thickness(terms_, cell, fill_[cell], pressure_[cell])
                        : 0.0;
  balance_[cell] += over_end;
  magnitude_[cell] += std::abs(over_end);
  double into_groove = 0.0;
  if (const double exchange = terms_.exchange(cell); exchange > 0.0) {
    const double groove = terms_.stage().recesses->pressure[cell];
    into_groove = exchange * (pressure_[cell] - groove) / terms_.pressure_scale();
    balance_[cell] += into_groove;
    magnitude_[cell] += exchange * (pressure_[cell] + groove) / terms_.pressure_scale();
  }
  if (extent.is(CellKind::kGroove, cell))
    into_groove = -balance_[cell];
  else if (extent.is(CellKind::kOutside, cell))
    over_end = -balance_[cell];
  else if (magnitude_[cell] > 0.0)
    residual_ = std::max(residual_, std::abs(balance_[cell]) / magnitude_[cell]);
  flows_[pad.end_flow(cell)] = over_end * flow_scale;
  if (pad.grooves()) flows_[pad.groove_flow(cell)] = into_groove * flow_scale;
  outflow_ += over_end + into_groove;
}

Eigen::ArrayXd Reynolds::density() const { return terms_.density(pressure_, fill_); }

Eigen::ArrayXd Reynolds::profile() const {
  if (!terms_.layers()) return fill_;
  return (fill_ * terms_.film().content).min(0.5 * terms_.film().carry);
}

ValueSlope Reynolds::sheared(int cell) const {
  const FilmExtent& extent = terms_.extent();
  if (extent.in_recess(cell)) return {0.0, 0.0};
  const double land =
      extent.is(CellKind::kBesideGroove, cell) ? 1.0 - terms_.stage().recesses->share[cell] : 1.0;
  if (is_full(cell) || !terms_.layers()) return {land * fill_[cell], is_full(cell) ? 0.0 : land};
  const bool both_walls = fill_[cell] > 0.5;
  return {both_walls ? land * (2.0 * fill_[cell] - 1.0) : 0.0, both_walls ? land * 2.0 : 0.0};
}

void Reynolds::speed_sensitivity(Eigen::ArrayXd& derivative) {
  slopes_.setZero(grid().size(), BandedLu::padded(1));
  BalanceSlopes(terms_, split_, pressure_, fill_).subtract_by_speed(slopes_);
  lu_.solve_rows(slopes_.data(), static_cast<int>(slopes_.cols()));
  derivative.resize(grid().size());
  for (int c = 0; c < grid().size(); ++c)
    derivative[c] = (is_full(c) ? terms_.pressure_scale() : 1.0) * slopes_(terms_.pad().row(c), 0);
}

void Reynolds::sensitivities(const RowMatrix& dh, RowMatrix& derivative,
                             const Eigen::VectorXd* height) {
  const int k = static_cast<int>(dh.cols());
  slopes_.setZero(grid().size(), BandedLu::padded(k));
  BalanceSlopes(terms_, split_, pressure_, fill_).subtract(dh, height, slopes_);
  lu_.solve_rows(slopes_.data(), static_cast<int>(slopes_.cols()));
  derivative.resize(grid().size(), k);
  for (int c = 0; c < grid().size(); ++c)
    derivative.row(c) =
        (is_full(c) ? terms_.pressure_scale() : 1.0) * slopes_.row(terms_.pad().row(c)).head(k);
}

}  // namespace clatter::film
