// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/reynolds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

// Sets change by entire regions in the first solves; when they still change after this many, cells
// are moved one by one (smallest index first), which cannot cycle on a P-matrix (Murty 1974).
constexpr int kBlockIterations = 40;
constexpr int kMaxIterations = 2000;
// Rounding level of p / p_max and of theta - 1: below it a cell on the border keeps its state.
constexpr double kBorder = 1e-13;

double face_conductance(double a, double b) { return 2.0 * a * a * b * b / (a + b); }
double face_carry(double a, double b) { return 2.0 * a * b / (a + b); }

}  // namespace

void FilmCells::resize(int n) {
  for (Eigen::ArrayXd* values : {&content, &d_content, &flow_angle, &d_flow_angle, &flow_axial,
                                 &d_flow_axial, &carry, &d_carry})
    values->setZero(n);
}

void FilmCells::set_smooth(const Eigen::ArrayXd& h) {
  for (Eigen::ArrayXd* values : {&content, &flow_angle, &flow_axial, &carry}) *values = h;
  for (Eigen::ArrayXd* values : {&d_content, &d_flow_angle, &d_flow_axial, &d_carry})
    values->setOnes(h.size());
}

Reynolds::Reynolds(const PadGrid& grid, const Edges& edges, bool cavitation)
    : grid_(grid), edges_(edges), cavitation_(cavitation) {
  build_faces();
  number_cells();
  const int n = grid_.size();
  full_.assign(static_cast<size_t>(n), 1);
  storage_.setZero(n);
  squeeze_.setZero(n);
  before_.setZero(n);
  x_.setZero(n);
  pressure_.setZero(n);
  fill_.setOnes(n);
  scratch_.setZero(n);
  magnitude_.setZero(n);
  conduct_.resize(faces_.size());
  carry_.resize(faces_.size());
  lift_.assign(faces_.size(), 0.0);
  rim_conduct_.resize(rims_.size());
  rim_carry_.resize(rims_.size());
  rim_entering_.resize(rims_.size());
}

void Reynolds::build_faces() {
  const int n_i = grid_.n_angle(), n_j = grid_.n_axial();
  for (int i = 0; i < n_i; ++i)
    for (int j = 0; j + 1 < n_j; ++j)
      faces_.push_back({grid_.cell(i, j), grid_.cell(i, j + 1), grid_.arc(i),
                        0.5 * (grid_.height(j) + grid_.height(j + 1)), true,
                        j > 0 ? grid_.cell(i, j - 1) : -1,
                        j + 2 < n_j ? grid_.cell(i, j + 2) : -1});
  auto around = [this, n_i](int i, int j) {
    if (grid_.periodic()) return grid_.cell((i + n_i) % n_i, j);
    return i >= 0 && i < n_i ? grid_.cell(i, j) : -1;
  };
  for (int i = 0; i + (grid_.periodic() ? 0 : 1) < n_i; ++i)
    for (int j = 0; j < n_j; ++j) {
      const int next = (i + 1) % n_i;
      faces_.push_back({grid_.cell(i, j), grid_.cell(next, j), grid_.height(j),
                        0.5 * (grid_.arc(i) + grid_.arc(next)), false, around(i - 1, j),
                        around(i + 2, j)});
    }
  auto add_rim = [this](int cell, double length, double distance, double sign, bool axial,
                        const Edge& edge) {
    if (edge.kind == Edge::Kind::kPressure)
      rims_.push_back({cell, length, distance, sign, axial, edge});
  };
  for (int i = 0; i < n_i; ++i) {
    add_rim(grid_.cell(i, 0), grid_.arc(i), 0.5 * grid_.height(0), -1.0, true, edges_.axial_begin);
    add_rim(grid_.cell(i, n_j - 1), grid_.arc(i), 0.5 * grid_.height(n_j - 1), 1.0, true,
            edges_.axial_end);
  }
  if (grid_.periodic()) return;
  for (int j = 0; j < n_j; ++j) {
    add_rim(grid_.cell(0, j), grid_.height(j), 0.5 * grid_.arc(0), -1.0, false, edges_.angle_begin);
    add_rim(grid_.cell(n_i - 1, j), grid_.height(j), 0.5 * grid_.arc(n_i - 1), 1.0, false,
            edges_.angle_end);
  }
}

// The short side varies fastest. Around a closed ring the columns are taken alternately from both
// ends of the angular range, so that closing the ring only doubles the band.
void Reynolds::number_cells() {
  const int n_i = grid_.n_angle(), n_j = grid_.n_axial();
  row_.resize(static_cast<size_t>(grid_.size()));
  const int axial_band = grid_.periodic() ? 2 * n_j : n_j;
  for (int i = 0; i < n_i; ++i) {
    const int folded = grid_.periodic() ? (2 * i < n_i ? 2 * i : 2 * (n_i - 1 - i) + 1) : i;
    for (int j = 0; j < n_j; ++j)
      row_[static_cast<size_t>(grid_.cell(i, j))] =
          axial_band <= n_i ? folded * n_j + j : j * n_i + i;
  }
  int band = 0;
  for (const Face& face : faces_)
    band = std::max(
        band, std::abs(row_[static_cast<size_t>(face.a)] - row_[static_cast<size_t>(face.b)]));
  lu_ = BandedLu(grid_.size(), band);
}

// Excess of the fill on a face over that of the upstream cell, as a fraction of the unfilled part
// of that cell.
double Reynolds::lift(const Face& face, double speed) const {
  if (stage_.fill_before == nullptr || speed == 0.0) return 0.0;
  const int upstream = speed > 0.0 ? face.a : face.b, downstream = speed > 0.0 ? face.b : face.a;
  const int beyond = speed > 0.0 ? face.beyond_a : face.beyond_b;
  const Eigen::ArrayXd& fill = *stage_.fill_before;
  const double lack = 1.0 - fill[upstream];
  if (beyond < 0 || lack <= 0.0) return 0.0;
  const double up = fill[upstream] - fill[beyond], down = fill[downstream] - fill[upstream];
  if (up * down <= 0.0) return 0.0;
  return std::clamp(up * down / (up + down) / lack, -1.0, 1.0);
}

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
    const int upstream = carried > 0.0 ? a : b;
    if (is_full(upstream)) {
      x_[pa] -= carried;
      x_[pb] += carried;
    } else {
      const double lifted = carried * lift_[f], rest = carried - lifted;
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

// Moves cells whose unknown violates its bound; true when the split changed.
bool Reynolds::update_split(bool one_at_a_time) {
  double highest = 0.0;
  for (int c = 0; c < grid_.size(); ++c)
    if (is_full(c)) highest = std::max(highest, x_[row_[static_cast<size_t>(c)]]);
  bool changed = false;
  for (int c = 0; c < grid_.size(); ++c) {
    const double value = x_[row_[static_cast<size_t>(c)]];
    const bool broken = is_full(c) ? value < -kBorder * highest : value > 1.0 + kBorder;
    if (!broken) continue;
    full_[static_cast<size_t>(c)] ^= 1;
    changed = true;
    if (one_at_a_time) break;
  }
  return changed;
}

Eigen::ArrayXd Reynolds::density() const {
  if (!(stage_.bulk_modulus > 0.0)) return fill_;
  return fill_ + pressure_ / stage_.bulk_modulus;
}

int Reynolds::solve(const FilmCells& film, const Eigen::ArrayXd& content_before,
                    const FilmStage& stage) {
  film_ = &film;
  stage_ = stage;
  weigh(film, content_before, stage);
  if (cavitation_ && !started_ && !stage.steady)
    for (int c = 0; c < grid_.size(); ++c)
      full_[static_cast<size_t>(c)] = before_[c] >= storage_[c];
  started_ = true;
  for (int iteration = 1; iteration <= kMaxIterations; ++iteration) {
    assemble();
    if (!lu_.factor())
      throw NumericsError("film: singular Reynolds matrix: a cell has neither storage nor flow");
    lu_.solve(x_.data());
    if (!x_.allFinite()) throw NumericsError("film: the Reynolds solution is not finite");
    if (!cavitation_ || !update_split(iteration > kBlockIterations)) {
      unpack();
      measure();
      return iteration;
    }
  }
  started_ = false;
  std::fill(full_.begin(), full_.end(), char{1});
  throw NumericsError(fmt::format("film: no split into full and cavitated cells found in {} solves",
                                  kMaxIterations));
}

void Reynolds::unpack() {
  for (int c = 0; c < grid_.size(); ++c) {
    const double value = x_[row_[static_cast<size_t>(c)]];
    const bool full = is_full(c);
    pressure_[c] = full ? (cavitation_ ? std::max(value, 0.0) : value) * pressure_scale_ : 0.0;
    fill_[c] = full ? 1.0 : std::min(value, 1.0);
  }
}

// Balance of each cell with the returned values, relative to its own terms.
void Reynolds::measure() {
  Eigen::ArrayXd& balance = scratch_;
  balance = storage_ * fill_ + squeeze_ * pressure_ / pressure_scale_ - before_;
  magnitude_ = storage_ * fill_.abs() + before_.abs();
  for (size_t f = 0; f < faces_.size(); ++f) {
    const int a = faces_[f].a, b = faces_[f].b;
    const double upstream = fill_[carry_[f] > 0.0 ? a : b];
    const double carried = carry_[f] * (upstream + lift_[f] * (1.0 - upstream));
    const double flow = conduct_[f] * (pressure_[a] - pressure_[b]) / pressure_scale_ + carried;
    const double size =
        conduct_[f] * (std::abs(pressure_[a]) + std::abs(pressure_[b])) / pressure_scale_ +
        std::abs(carried);
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
    out += flow;
  }
  outflow_ = out * volume_scale_;
  residual_ = 0.0;
  for (int c = 0; c < grid_.size(); ++c)
    if (magnitude_[c] > 0.0) residual_ = std::max(residual_, std::abs(balance[c]) / magnitude_[c]);
}

}  // namespace clatter::film
