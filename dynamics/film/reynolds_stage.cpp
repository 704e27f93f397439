// SPDX-License-Identifier: GPL-3.0-or-later
// The linear system of one stage for a given split, and what its solution says.
#include <algorithm>
#include <cmath>

#include "dynamics/film/face_law.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

Reynolds::CellKind Reynolds::kind_of(int cell) const {
  if (partial_ && stage_.cover->share[cell % grid_.n_axial()] == 0.0) return CellKind::kOutside;
  const RecessCells* recesses = stage_.recesses;
  if (recesses == nullptr || recesses->share[cell] == 0.0) return CellKind::kFilm;
  if (!recesses->covered(cell)) return CellKind::kBesideGroove;
  return recesses->window[cell] ? CellKind::kWindow : CellKind::kGroove;
}

void Reynolds::weigh(const FilmCells& film, const Eigen::ArrayXd& content_before,
                     const FilmStage& stage) {
  const double kappa = stage.steady ? 1.0 : stage.kappa;
  const double mobility = kappa / (12.0 * stage.viscosity);
  double conduct_sum = 0.0, carry_sum = 0.0;
  partial_ = stage.cover != nullptr && (stage.cover->share < 1.0).any();
  kind_.resize(grid_.size());
  for (int c = 0; c < grid_.size(); ++c) kind_[c] = kind_of(c);
  auto weigh_one = [&](double conductance, double carry, double length, const Inside& in,
                       bool axial, double& t, double& c) {
    t = mobility * conductance * (length * in.length) / in.distance;
    c = kappa * (axial ? stage.speed_axial : stage.speed_angle) * (length * in.carried) * carry;
    conduct_sum += t;
    carry_sum += std::abs(c);
  };
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const Eigen::ArrayXd& g = face.axial ? film.flow_axial : film.flow_angle;
    const Inside in = inside(face);
    if (in.length == 0.0 &&
        in.carried == 0.0) {  // outside, where walls that overlap have no thickness at all
      conduct_[f] = carry_[f] = lift_[f] = 0.0;
      ratio_[f] = 1.0;
      continue;
    }
    const auto [g_a, g_b] = in.beside(g[face.a], g[face.b]);
    const auto [c_a, c_b] = in.beside(film.carry[face.a], film.carry[face.b]);
    weigh_one(face_conductance(g_a, g_b), face_carry(c_a, c_b), face.length, in, face.axial,
              conduct_[f], carry_[f]);
    lift_[f] = lift(face, face.axial ? stage.speed_axial : stage.speed_angle);
    // At least 1: a cell that fills must not carry less than it will when it is full.
    if (layers())
      ratio_[f] = std::max(
          2.0 * (1.0 + lift_[f]) * film.content[content_cell(f)] / face_carry(c_a, c_b), 1.0);
  }
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = rims_[r];
    if (is(CellKind::kOutside, rim.cell)) {
      rim_conduct_[r] = rim_carry_[r] = rim_entering_[r] = 0.0;
      rim_ratio_[r] = 1.0;
      continue;
    }
    const double g = (rim.axial ? film.flow_axial : film.flow_angle)[rim.cell];
    weigh_one(g * g * g, film.carry[rim.cell], rim.length, inside(rim), rim.axial, rim_conduct_[r],
              rim_carry_[r]);
    rim_carry_[r] *= rim.sign;
    const double carry = film.carry[rim.cell];
    rim_entering_[r] = std::min(rim_carry_[r], 0.0) * entering(rim.edge, rim.cell).value / carry;
    rim_ratio_[r] = layers() ? std::max(2.0 * film.content[rim.cell] / carry, 1.0) : 1.0;
  }
  const double count = static_cast<double>(faces_.size() + rims_.size());
  storage_ = film.content * grid_.area();
  if (partial_) storage_ *= stage.cover->of_cells(grid_.n_angle());
  volume_scale_ = stage.steady ? carry_sum / count : storage_.mean();
  if (!(volume_scale_ > 0.0)) volume_scale_ = 1.0;
  if (!(conduct_sum > 0.0)) conduct_sum = 1.0;  // the entire pad is outside
  pressure_scale_ = volume_scale_ * count / conduct_sum;
  for (std::vector<double>* values : {&conduct_, &rim_conduct_})
    for (double& t : *values) t *= pressure_scale_ / volume_scale_;
  for (std::vector<double>* values : {&carry_, &rim_carry_, &rim_entering_})
    for (double& c : *values) c /= volume_scale_;
  if (stage.steady) {
    storage_.setZero();
    before_.setZero();
  } else {
    storage_ /= volume_scale_;
    before_ = content_before * grid_.area() / volume_scale_;
  }
  squeeze_ = storage_ * (stage.bulk_modulus > 0.0 ? pressure_scale_ / stage.bulk_modulus : 0.0);
  if (partial_) weigh_ends();
  if (reservoirs_) weigh_reservoirs(mobility);
}

// The row of a cell outside the liner or in a groove holds only what is given.
void Reynolds::assemble() {
  lu_.set_zero();
  auto row_of = [this](int cell) { return row_[cell]; };
  auto add = [&](int cell, int unknown, double value) {
    if (!is_given(cell)) lu_.at(row_of(cell), row_of(unknown)) += value;
  };
  auto give = [&](int cell, double value) {
    if (!is_given(cell)) x_[row_of(cell)] += value;
  };
  for (int c = 0; c < grid_.size(); ++c) {
    if (is(CellKind::kOutside, c)) {
      x_[row_of(c)] = edges_.liner_end.pressure / pressure_scale_;
      lu_.at(row_of(c), row_of(c)) = 1.0;
      continue;
    }
    if (is(CellKind::kGroove, c)) {
      x_[row_of(c)] =
          is_full(c) ? stage_.recesses->pressure[c] / pressure_scale_ : stage_.recesses->fill[c];
      lu_.at(row_of(c), row_of(c)) = 1.0;
      continue;
    }
    x_[row_of(c)] = before_[c];
    if (is_full(c)) x_[row_of(c)] -= storage_[c];
    add(c, c, is_full(c) ? squeeze_[c] : storage_[c]);
  }
  for (size_t f = 0; f < faces_.size(); ++f) {
    const int a = faces_[f].a, b = faces_[f].b;
    const double t = conduct_[f], carried = carry_[f];
    if (is_full(a)) {
      add(a, a, t);
      add(b, a, -t);
    }
    if (is_full(b)) {
      add(b, b, t);
      add(a, b, -t);
    }
    const int upstream = upstream_of(f);
    const FaceFill law = is_full(upstream) ? FaceFill{1.0, 1.0} : face_fill(f);
    const double lifted = carried * law.empty, rest = carried * law.full - lifted;
    give(a, -lifted);
    give(b, lifted);
    if (is_full(upstream)) continue;
    add(a, upstream, rest);
    add(b, upstream, -rest);
  }
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = rims_[r];
    give(rim.cell, rim_conduct_[r] * rim.edge.pressure / pressure_scale_);
    if (is_full(rim.cell)) add(rim.cell, rim.cell, rim_conduct_[r]);
    const double carried = rim_carry_[r];
    if (carried > 0.0 && !is_full(rim.cell) && rim_limited_[r] == 0)
      add(rim.cell, rim.cell, carried * rim_ratio_[r]);
    else
      give(rim.cell, -(carried > 0.0 ? carried : rim_entering_[r]));
  }
  for (int c = 0; reservoirs_ && c < grid_.size(); ++c) {
    if (exchange_[c] == 0.0) continue;
    give(c, exchange_[c] * stage_.recesses->pressure[c] / pressure_scale_);
    if (is_full(c)) add(c, c, exchange_[c]);
  }
  for (int c = 0; partial_ && c < grid_.size(); ++c) {
    if (covered_[c] == 0.0) continue;
    const FaceFill law = end_law(c);
    const double area = std::abs(covered_[c]);
    give(c, -area * (is_full(c) ? law.full : law.empty));
    if (!is_full(c))
      add(c, c, area * (law.full - law.empty));
    else if (covered_[c] < 0.0 && stage_.bulk_modulus > 0.0)
      add(c, c, area * film_.content[c] * pressure_scale_ / stage_.bulk_modulus);
  }
}

Eigen::ArrayXd Reynolds::density() const {
  if (!(stage_.bulk_modulus > 0.0)) return fill_;
  return fill_ + pressure_ / stage_.bulk_modulus;
}

void Reynolds::unpack() {
  for (int c = 0; c < grid_.size(); ++c) {
    const double value = x_[row_[c]];
    const bool full = is_full(c);
    pressure_[c] = full ? (cavitation_ ? std::max(value, 0.0) : value) * pressure_scale_ : 0.0;
    // Beyond the bounds by rounding; a window holds more than its own gap.
    fill_[c] = is(CellKind::kOutside, c) ? 0.0
               : full                    ? 1.0
                      : std::clamp(value, 0.0, is(CellKind::kWindow, c) ? INFINITY : 1.0);
  }
}

// Balance of each cell with the returned values, relative to its own terms.
void Reynolds::measure() {
  Eigen::ArrayXd& balance = scratch_;
  balance = storage_ * fill_ + squeeze_ * pressure_ / pressure_scale_ - before_;
  magnitude_ = storage_ * fill_.abs() + before_.abs();
  const double flow_scale = volume_scale_ / (stage_.steady ? 1.0 : stage_.kappa);
  for (size_t f = 0; f < faces_.size(); ++f) {
    const int a = faces_[f].a, b = faces_[f].b;
    const double carried = carry_[f] * fill_on_face(f);
    const double flow = conduct_[f] * (pressure_[a] - pressure_[b]) / pressure_scale_ + carried;
    const double size =
        conduct_[f] * (std::abs(pressure_[a]) + std::abs(pressure_[b])) / pressure_scale_ +
        std::abs(carried);
    flows_[static_cast<Eigen::Index>(f)] = flow * flow_scale;
    balance[a] += flow;
    balance[b] -= flow;
    magnitude_[a] += size;
    magnitude_[b] += size;
  }
  double out = 0.0;
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = rims_[r];
    const double carried = rim_carry_[r] > 0.0 ? rim_carry_[r] * fill_on_rim(r) : rim_entering_[r];
    const double flow =
        rim_conduct_[r] * (pressure_[rim.cell] - rim.edge.pressure) / pressure_scale_ + carried;
    balance[rim.cell] += flow;
    magnitude_[rim.cell] +=
        rim_conduct_[r] * (std::abs(pressure_[rim.cell]) + rim.edge.pressure) / pressure_scale_ +
        std::abs(carried);
    flows_[static_cast<Eigen::Index>(faces_.size() + r)] = flow * flow_scale;
    out += flow;
  }
  residual_ = 0.0;
  for (int c = 0; c < grid_.size(); ++c) {
    double flow = partial_ ? std::abs(covered_[c]) * end_thickness(c) : 0.0;
    balance[c] += flow;
    magnitude_[c] += std::abs(flow);
    double given = 0.0;  // into a groove
    if (reservoirs_ && exchange_[c] > 0.0) {
      given = exchange_[c] * (pressure_[c] - stage_.recesses->pressure[c]) / pressure_scale_;
      balance[c] += given;
      magnitude_[c] +=
          exchange_[c] * (pressure_[c] + stage_.recesses->pressure[c]) / pressure_scale_;
    }
    if (is(CellKind::kGroove, c))
      given = -balance[c];
    else if (is(CellKind::kOutside, c))
      flow = -balance[c];
    else if (magnitude_[c] > 0.0)
      residual_ = std::max(residual_, std::abs(balance[c]) / magnitude_[c]);
    const auto at = static_cast<Eigen::Index>(faces_.size() + rims_.size()) + c;
    flows_[at] = flow * flow_scale;
    if (reservoirs_) flows_[at + grid_.size()] = given * flow_scale;
    out += flow + given;
  }
  outflow_ = out * volume_scale_;
}

}  // namespace clatter::film
