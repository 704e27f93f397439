// SPDX-License-Identifier: GPL-3.0-or-later
// The film of a pad that is partly outside the liner.
#include "dynamics/film/face_law.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

// The less covered cell's value counts in proportion to its cover: none at all for one outside,
// whose gap may be closed.
std::pair<double, double> Reynolds::Inside::beside(double a, double b) const {
  if (outer == 1.0) return {a, b};
  if (outer_is_b) return {a, a + outer * (b - a)};
  return {b + outer * (a - b), b};
}

void Reynolds::Inside::to_cells(double& by_a, double& by_b) const {
  if (outer == 1.0) return;
  double &by_outer = outer_is_b ? by_b : by_a, &by_inner = outer_is_b ? by_a : by_b;
  by_inner += (1.0 - outer) * by_outer;
  by_outer *= outer;
}

Reynolds::Inside Reynolds::inside(const Face& face) const {
  Inside in = covered_part(face);
  if (stage_.recesses != nullptr) edge_of_recess(face, in);
  return in;
}

Reynolds::Inside Reynolds::covered_part(const Face& face) const {
  Inside in{.distance = face.distance};
  if (!partial_) return in;
  const Cover& cover = *stage_.cover;
  const int j_a = face.a % grid_.n_axial(), j_b = face.b % grid_.n_axial();
  const double w_a = cover.share[j_a], w_b = cover.share[j_b];
  const double d_a = cover.share_slope[j_a], d_b = cover.share_slope[j_b];
  if (!face.axial) {
    in.length = in.carried = w_a;
    in.length_slope = in.carried_slope = d_a;
    return in;
  }
  if (w_a == 0.0 && w_b == 0.0) {
    in.length = in.carried = 0.0;
    return in;
  }
  in.carried = cover.edge[j_b];
  in.carried_slope = cover.edge_slope[j_b];
  in.distance = 0.5 * (w_a * grid_.height(j_a) + w_b * grid_.height(j_b));
  in.distance_slope = 0.5 * (d_a * grid_.height(j_a) + d_b * grid_.height(j_b));
  in.outer_is_b = w_b <= w_a;
  in.outer = in.outer_is_b ? w_b / w_a : w_a / w_b;
  in.outer_slope = in.outer_is_b ? (d_b - in.outer * d_a) / w_a : (d_a - in.outer * d_b) / w_b;
  return in;
}

Reynolds::Inside Reynolds::inside(const Rim& rim) const {
  Inside in{.distance = rim.distance};
  if (!partial_) return in;
  const Cover& cover = *stage_.cover;
  const int j = rim.cell % grid_.n_axial();
  if (!rim.axial || cover.share[j] == 0.0) {
    in.length = in.carried = cover.share[j];
    in.length_slope = in.carried_slope = cover.share_slope[j];
    return in;
  }
  const int edge = rim.sign < 0.0 ? j : j + 1;
  in.distance = cover.share[j] * rim.distance;
  in.distance_slope = cover.share_slope[j] * rim.distance;
  in.carried = cover.edge[edge];
  in.carried_slope = cover.edge_slope[edge];
  return in;
}

// The liner slides past the grid at 2 U_m and its ends with it.
void Reynolds::weigh_ends() {
  const Cover& cover = *stage_.cover;
  const double slid = -2.0 * stage_.kappa * stage_.speed_axial / volume_scale_;
  for (int c = 0; c < grid_.size(); ++c) {
    const int j = c % grid_.n_axial();
    const double arc = grid_.arc(c / grid_.n_axial());
    covered_[c] =
        is(CellKind::kOutside, c) ? 0.0 : slid * arc * (cover.edge[j + 1] - cover.edge[j]);
  }
}

// Thickness [m] that leaves a cell with each part of its area that is covered (negative) or
// uncovered: the oil on the grid's wall.
Reynolds::FaceFill Reynolds::end_law(int cell) const {
  if (covered_[cell] > 0.0) {
    const double brought = 0.5 * entering(edges_.liner_end, cell).value;
    return {-brought, -brought};
  }
  const double half = 0.5 * film_.carry[cell], rest = film_.content[cell] - half;
  if (!layers()) return {0.0, rest};
  if (is_full(cell) || end_limited_[cell] != 0) return {-half, rest};
  return {0.0, 0.0};
}

double Reynolds::end_thickness(int cell) const {
  const FaceFill law = end_law(cell);
  const double theta = fill_[cell];
  const double squeezed = covered_[cell] < 0.0 && stage_.bulk_modulus > 0.0
                              ? film_.content[cell] * pressure_[cell] / stage_.bulk_modulus
                              : 0.0;
  return law.empty + (law.full - law.empty) * theta + squeezed;
}

// By the gap.
double Reynolds::end_thickness_slope(int cell) const {
  if (covered_[cell] > 0.0) return -0.5 * entering(edges_.liner_end, cell).slope;
  const double d_half = 0.5 * film_.d_carry[cell], d_content = film_.d_content[cell];
  const double squeezed = stage_.bulk_modulus > 0.0 ? pressure_[cell] / stage_.bulk_modulus : 0.0;
  if (!layers()) return fill_[cell] * (d_content - d_half) + squeezed * d_content;
  if (is_full(cell) || end_limited_[cell] != 0)
    return (fill_[cell] + squeezed) * d_content - d_half;
  return 0.0;
}

// Derivative of each cell's balance by the pad's height at fixed unknowns and gaps.
Eigen::ArrayXd Reynolds::height_slopes() const {
  const FilmCells& film = film_;
  const Cover& cover = *stage_.cover;
  const double mobility = stage_.kappa / (12.0 * stage_.viscosity) / volume_scale_;
  Eigen::ArrayXd slopes = density() * film.content * grid_.area() / volume_scale_;
  slopes *= cover.share_slope.replicate(grid_.n_angle(), 1);
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const int a = face.a, b = face.b;
    const Inside in = inside(face);
    const Eigen::ArrayXd& g = face.axial ? film.flow_axial : film.flow_angle;
    const auto [g_a, g_b] = in.beside(g[a], g[b]);
    const auto [c_a, c_b] = in.beside(film.carry[a], film.carry[b]);
    // Of a function of two values beside the face through that of the less covered cell.
    auto through_outer = [&](auto&& slope, double v_a, double v_b, double own_a, double own_b) {
      return in.outer_is_b ? slope(v_b, v_a) * (own_b - own_a) * in.outer_slope
                           : slope(v_a, v_b) * (own_a - own_b) * in.outer_slope;
    };
    const double conductance = face_conductance(g_a, g_b);
    double by_height =
        conductance * (in.length_slope - in.length * in.distance_slope / in.distance);
    by_height += in.length * through_outer(conductance_slope, g_a, g_b, g[a], g[b]);
    by_height *= mobility * face.length / in.distance * (pressure_[a] - pressure_[b]);
    const double speed = face.axial ? stage_.speed_axial : stage_.speed_angle;
    const double moved = stage_.kappa * speed * face.length / volume_scale_;
    const double fill = fill_on_face(f);
    by_height += moved * fill * face_carry(c_a, c_b) * in.carried_slope;
    if (!carries_content(f))
      by_height += moved * fill * in.carried *
                   through_outer(carry_slope, c_a, c_b, film.carry[a], film.carry[b]);
    slopes[a] += by_height;
    slopes[b] -= by_height;
  }
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = rims_[r];
    const int c = rim.cell;
    const Inside in = inside(rim);
    const double g = (rim.axial ? film.flow_axial : film.flow_angle)[c];
    const double outward = rim.sign * (rim.axial ? stage_.speed_axial : stage_.speed_angle);
    const double carried =
        outward > 0.0 ? fill_on_rim(r) * film.carry[c] : entering(rim.edge, c).value;
    slopes[c] += mobility * rim.length / in.distance * g * g * g *
                     (in.length_slope - in.length * in.distance_slope / in.distance) *
                     (pressure_[c] - rim.edge.pressure) +
                 stage_.kappa * outward * rim.length * carried * in.carried_slope / volume_scale_;
  }
  const double slid = -2.0 * stage_.kappa * stage_.speed_axial / volume_scale_;
  for (int c = 0; c < grid_.size(); ++c) {
    if (covered_[c] == 0.0) continue;
    const int j = c % grid_.n_axial();
    const double arc = grid_.arc(c / grid_.n_axial());
    const double by_height = slid * arc * (cover.edge_slope[j + 1] - cover.edge_slope[j]);
    slopes[c] += (covered_[c] > 0.0 ? by_height : -by_height) * end_thickness(c);
  }
  return slopes;
}

}  // namespace clatter::film
