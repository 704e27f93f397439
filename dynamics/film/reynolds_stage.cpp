// SPDX-License-Identifier: GPL-3.0-or-later
// The linear system of one stage for a given split, and what its solution says.
#include <algorithm>
#include <cmath>

#include "dynamics/film/reynolds.hpp"

namespace clatter::film {
namespace {

double face_conductance(double a, double b) { return 2.0 * a * a * b * b / (a + b); }
double face_carry(double a, double b) { return 2.0 * a * b / (a + b); }

}  // namespace

void Reynolds::weigh(const FilmCells& film, const Eigen::ArrayXd& content_before,
                     const FilmStage& stage) {
  const double kappa = stage.steady ? 1.0 : stage.kappa;
  const double mobility = kappa / (12.0 * stage.viscosity);
  double conduct_sum = 0.0, carry_sum = 0.0;
  auto weigh_one = [&](double conductance, double carry, double length, double distance, bool axial,
                       double& t, double& c) {
    t = mobility * conductance * length / distance;
    c = kappa * (axial ? stage.speed_axial : stage.speed_angle) * length * carry;
    conduct_sum += t;
    carry_sum += std::abs(c);
  };
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const Eigen::ArrayXd& g = face.axial ? film.flow_axial : film.flow_angle;
    weigh_one(face_conductance(g[face.a], g[face.b]),
              face_carry(film.carry[face.a], film.carry[face.b]), face.length, face.distance,
              face.axial, conduct_[f], carry_[f]);
    lift_[f] = lift(face, face.axial ? stage.speed_axial : stage.speed_angle);
  }
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = rims_[r];
    const double g = (rim.axial ? film.flow_axial : film.flow_angle)[rim.cell];
    weigh_one(g * g * g, film.carry[rim.cell], rim.length, rim.distance, rim.axial, rim_conduct_[r],
              rim_carry_[r]);
    rim_carry_[r] *= rim.sign;
    // The inflow of a layer thinner than the gap does not depend on the gap.
    const double carry = film.carry[rim.cell];
    rim_entering_[r] =
        std::min(rim_carry_[r], 0.0) * std::min(rim.edge.fill, rim.edge.layer / carry);
  }
  const double count = static_cast<double>(faces_.size() + rims_.size());
  volume_scale_ = stage.steady ? carry_sum / count : (film.content * grid_.area()).mean();
  if (!(volume_scale_ > 0.0)) volume_scale_ = 1.0;
  pressure_scale_ = volume_scale_ * count / conduct_sum;
  for (std::vector<double>* values : {&conduct_, &rim_conduct_})
    for (double& t : *values) t *= pressure_scale_ / volume_scale_;
  for (std::vector<double>* values : {&carry_, &rim_carry_, &rim_entering_})
    for (double& c : *values) c /= volume_scale_;
  if (stage.steady) {
    storage_.setZero();
    before_.setZero();
  } else {
    storage_ = film.content * grid_.area() / volume_scale_;
    before_ = content_before * grid_.area() / volume_scale_;
  }
  squeeze_ = storage_ * (stage.bulk_modulus > 0.0 ? pressure_scale_ / stage.bulk_modulus : 0.0);
}

void Reynolds::assemble() {
  lu_.set_zero();
  auto row_of = [this](int cell) { return row_[static_cast<size_t>(cell)]; };
  for (int c = 0; c < grid_.size(); ++c) {
    x_[row_of(c)] = before_[c];
    if (is_full(c)) {
      x_[row_of(c)] -= storage_[c];
      lu_.at(row_of(c), row_of(c)) += squeeze_[c];
    } else {
      lu_.at(row_of(c), row_of(c)) += storage_[c];
    }
  }
  for (size_t f = 0; f < faces_.size(); ++f) {
    const int a = faces_[f].a, b = faces_[f].b, pa = row_of(a), pb = row_of(b);
    const double t = conduct_[f], carried = carry_[f];
    if (is_full(a)) {
      lu_.at(pa, pa) += t;
      lu_.at(pb, pa) -= t;
    }
    if (is_full(b)) {
      lu_.at(pb, pb) += t;
      lu_.at(pa, pb) -= t;
    }
    const int upstream = upstream_of(f);
    if (is_full(upstream)) {
      x_[pa] -= carried;
      x_[pb] += carried;
    } else {
      const FaceFill law = face_fill(f);
      const double lifted = carried * law.empty, rest = carried * law.full - lifted;
      x_[pa] -= lifted;
      x_[pb] += lifted;
      lu_.at(pa, row_of(upstream)) += rest;
      lu_.at(pb, row_of(upstream)) -= rest;
    }
  }
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = rims_[r];
    const int row = row_of(rim.cell);
    x_[row] += rim_conduct_[r] * rim.edge.pressure / pressure_scale_;
    if (is_full(rim.cell)) lu_.at(row, row) += rim_conduct_[r];
    const double carried = rim_carry_[r];
    if (carried > 0.0 && !is_full(rim.cell)) {
      lu_.at(row, row) += carried;
    } else {
      x_[row] -= carried > 0.0 ? carried : rim_entering_[r];
    }
  }
}

Eigen::ArrayXd Reynolds::density() const {
  if (!(stage_.bulk_modulus > 0.0)) return fill_;
  return fill_ + pressure_ / stage_.bulk_modulus;
}

void Reynolds::unpack() {
  for (int c = 0; c < grid_.size(); ++c) {
    const double value = x_[row_[static_cast<size_t>(c)]];
    const bool full = is_full(c);
    pressure_[c] = full ? (cavitation_ ? std::max(value, 0.0) : value) * pressure_scale_ : 0.0;
    fill_[c] = full ? 1.0 : std::clamp(value, 0.0, 1.0);  // outside by rounding
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
    const double carried = rim_carry_[r] > 0.0 ? rim_carry_[r] * fill_[rim.cell] : rim_entering_[r];
    const double flow =
        rim_conduct_[r] * (pressure_[rim.cell] - rim.edge.pressure) / pressure_scale_ + carried;
    balance[rim.cell] += flow;
    magnitude_[rim.cell] +=
        rim_conduct_[r] * (std::abs(pressure_[rim.cell]) + rim.edge.pressure) / pressure_scale_ +
        std::abs(carried);
    flows_[static_cast<Eigen::Index>(faces_.size() + r)] = flow * flow_scale;
    out += flow;
  }
  outflow_ = out * volume_scale_;
  residual_ = 0.0;
  for (int c = 0; c < grid_.size(); ++c)
    if (magnitude_[c] > 0.0) residual_ = std::max(residual_, std::abs(balance[c]) / magnitude_[c]);
}

}  // namespace clatter::film
