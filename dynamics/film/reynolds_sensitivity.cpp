// SPDX-License-Identifier: GPL-3.0-or-later
// Exact derivatives of the film solution by the gap, by reusing the factor of the last solve.
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {
namespace {

// d/da of 2 a^2 b^2 / (a + b).
double conductance_slope(double a, double b) {
  return 2.0 * a * b * b * (a + 2.0 * b) / ((a + b) * (a + b));
}
// d/da of 2 a b / (a + b).
double carry_slope(double a, double b) { return 2.0 * b * b / ((a + b) * (a + b)); }

}  // namespace

void Reynolds::sensitivities(const RowMatrix& dh, RowMatrix& derivative) {
  const FilmCells& film = *film_;
  const int k = static_cast<int>(dh.cols());
  const double kappa = stage_.steady ? 1.0 : stage_.kappa;
  const double mobility = kappa / (12.0 * stage_.viscosity) / volume_scale_;
  work_.setZero(grid_.size(), BandedLu::padded(k));
  auto row = [this, k](int cell) { return work_.row(row_[static_cast<size_t>(cell)]).head(k); };
  if (!stage_.steady) {
    const Eigen::ArrayXd held = density();
    for (int c = 0; c < grid_.size(); ++c)
      row(c) = -(grid_.area()[c] * held[c] * film.d_content[c] / volume_scale_) * dh.row(c);
  }
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const int a = face.a, b = face.b;
    const Eigen::ArrayXd& g = face.axial ? film.flow_axial : film.flow_angle;
    const Eigen::ArrayXd& dg = face.axial ? film.d_flow_axial : film.d_flow_angle;
    const double speed = face.axial ? stage_.speed_axial : stage_.speed_angle;
    const double drive = mobility * face.length / face.distance * (pressure_[a] - pressure_[b]);
    const double drag = kappa * speed * face.length * fill_on_face(f) / volume_scale_;
    const double by_a = drive * conductance_slope(g[a], g[b]) * dg[a] +
                        drag * carry_slope(film.carry[a], film.carry[b]) * film.d_carry[a];
    const double by_b = drive * conductance_slope(g[b], g[a]) * dg[b] +
                        drag * carry_slope(film.carry[b], film.carry[a]) * film.d_carry[b];
    if (by_a == 0.0 && by_b == 0.0) continue;
    auto to_a = row(a), to_b = row(b);
    for (int m = 0; m < k; ++m) {
      const double flow = by_a * dh(a, m) + by_b * dh(b, m);
      to_a[m] -= flow;
      to_b[m] += flow;
    }
  }
  for (const Rim& rim : rims_) {
    const int c = rim.cell;
    const double g = (rim.axial ? film.flow_axial : film.flow_angle)[c];
    const double dg = (rim.axial ? film.d_flow_axial : film.d_flow_angle)[c];
    const double outward = rim.sign * (rim.axial ? stage_.speed_axial : stage_.speed_angle);
    const double drive = mobility * rim.length / rim.distance * (pressure_[c] - rim.edge.pressure);
    const bool layer_bound = rim.edge.fill * film.carry[c] > rim.edge.layer;
    const double content = outward > 0.0 ? fill_[c] : layer_bound ? 0.0 : rim.edge.fill;
    const double drag = kappa * outward * rim.length * content / volume_scale_;
    row(c) -= (drive * 3.0 * g * g * dg + drag * film.d_carry[c]) * dh.row(c);
  }
  lu_.solve_rows(work_.data(), static_cast<int>(work_.cols()));
  derivative.resize(grid_.size(), k);
  for (int c = 0; c < grid_.size(); ++c)
    derivative.row(c) = (is_full(c) ? pressure_scale_ : 1.0) * row(c);
}

}  // namespace clatter::film
