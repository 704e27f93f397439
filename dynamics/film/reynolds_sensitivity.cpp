// SPDX-License-Identifier: GPL-3.0-or-later
// Exact derivatives of the film solution by the gap, by reusing the factor of the last solve.
#include <cmath>

#include "dynamics/film/face_law.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {
void Reynolds::sensitivities(const RowMatrix& dh, RowMatrix& derivative,
                             const Eigen::VectorXd* height) {
  const FilmCells& film = film_;
  const int k = static_cast<int>(dh.cols());
  const double kappa = stage_.steady ? 1.0 : stage_.kappa;
  const double mobility = kappa / (12.0 * stage_.viscosity) / volume_scale_;
  work_.setZero(grid_.size(), BandedLu::padded(k));
  auto row = [this, k](int cell) { return work_.row(row_[cell]).head(k); };
  if (!stage_.steady) {
    Eigen::ArrayXd held = density() * grid_.area();
    if (partial_) held *= stage_.cover->of_cells(grid_.n_angle());
    for (int c = 0; c < grid_.size(); ++c)
      row(c) = -(held[c] * film.d_content[c] / volume_scale_ +
                 (partial_ ? std::abs(covered_[c]) * end_thickness_slope(c) : 0.0)) *
               dh.row(c);
  }
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const int a = face.a, b = face.b;
    const Eigen::ArrayXd& g = face.axial ? film.flow_axial : film.flow_angle;
    const Eigen::ArrayXd& dg = face.axial ? film.d_flow_axial : film.d_flow_angle;
    const double speed = face.axial ? stage_.speed_axial : stage_.speed_angle;
    const Inside in = inside(face);
    const double drive =
        mobility * face.length * in.length / in.distance * (pressure_[a] - pressure_[b]);
    const double moved = kappa * speed * face.length * in.carried / volume_scale_;
    // By the values beside the face, and from those to the cells' own.
    const auto [g_a, g_b] = in.beside(g[a], g[b]);
    double by_a = drive * conductance_slope(g_a, g_b), by_b = drive * conductance_slope(g_b, g_a);
    in.to_cells(by_a, by_b);
    by_a *= dg[a];
    by_b *= dg[b];
    const int upstream = upstream_of(f);
    if (carries_content(f)) {
      (content_cell(f) == a ? by_a : by_b) +=
          moved * 2.0 * (1.0 + lift_[f]) * fill_[upstream] * film.d_content[content_cell(f)];
    } else {
      const double drag = moved * fill_on_face(f);
      const auto [c_a, c_b] = in.beside(film.carry[a], film.carry[b]);
      double by_c_a = drag * carry_slope(c_a, c_b), by_c_b = drag * carry_slope(c_b, c_a);
      in.to_cells(by_c_a, by_c_b);
      by_a += by_c_a * film.d_carry[a];
      by_b += by_c_b * film.d_carry[b];
    }
    if (by_a == 0.0 && by_b == 0.0) continue;
    auto to_a = row(a), to_b = row(b);
    for (int m = 0; m < k; ++m) {
      const double flow = by_a * dh(a, m) + by_b * dh(b, m);
      to_a[m] -= flow;
      to_b[m] += flow;
    }
  }
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = rims_[r];
    const int c = rim.cell;
    const double g = (rim.axial ? film.flow_axial : film.flow_angle)[c];
    const double dg = (rim.axial ? film.d_flow_axial : film.d_flow_angle)[c];
    const double outward = rim.sign * (rim.axial ? stage_.speed_axial : stage_.speed_angle);
    const Inside in = inside(rim);
    const double drive =
        mobility * rim.length * in.length / in.distance * (pressure_[c] - rim.edge.pressure);
    const bool layer = rim_ratio_[r] > 1.0 && !is_full(c) && rim_limited_[r] == 0;
    const double carried = outward <= 0.0 ? entering(rim.edge, c).slope
                           : layer        ? 2.0 * fill_[c] * film.d_content[c]
                                          : fill_on_rim(r) * film.d_carry[c];
    const double drag = kappa * outward * rim.length * in.carried * carried / volume_scale_;
    row(c) -= (drive * 3.0 * g * g * dg + drag) * dh.row(c);
  }
  if (partial_ && height != nullptr) {
    const Eigen::ArrayXd slopes = height_slopes();
    for (int c = 0; c < grid_.size(); ++c) row(c) -= slopes[c] * height->transpose();
  }
  for (int c = 0; partial_ && c < grid_.size(); ++c)
    if (is(CellKind::kOutside, c)) row(c).setZero();
  if (reservoirs_ && stage_.recesses != nullptr) add_reservoirs(mobility, dh);
  lu_.solve_rows(work_.data(), static_cast<int>(work_.cols()));
  derivative.resize(grid_.size(), k);
  for (int c = 0; c < grid_.size(); ++c)
    derivative.row(c) = (is_full(c) ? pressure_scale_ : 1.0) * row(c);
}

// What the wall carries is proportional to its speed.
void Reynolds::speed_sensitivity(Eigen::ArrayXd& derivative) {
  derivative.setZero(grid_.size());
  const double speed = stage_.speed_axial;
  if (speed == 0.0) return;
  for (size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_[f].axial) continue;
    const double flow = carry_[f] * fill_on_face(f);
    derivative[faces_[f].a] -= flow;
    derivative[faces_[f].b] += flow;
  }
  for (size_t r = 0; r < rims_.size(); ++r)
    if (rims_[r].axial)
      derivative[rims_[r].cell] -=
          rim_carry_[r] > 0.0 ? rim_carry_[r] * fill_on_rim(r) : rim_entering_[r];
  work_.setZero(grid_.size(), BandedLu::padded(1));
  for (int c = 0; c < grid_.size(); ++c) {
    if (is_given(c)) continue;
    if (partial_) derivative[c] -= std::abs(covered_[c]) * end_thickness(c);
    work_(row_[c], 0) = derivative[c] / speed;
  }
  lu_.solve_rows(work_.data(), static_cast<int>(work_.cols()));
  for (int c = 0; c < grid_.size(); ++c)
    derivative[c] = (is_full(c) ? pressure_scale_ : 1.0) * work_(row_[c], 0);
}

}  // namespace clatter::film
