// SPDX-License-Identifier: GPL-3.0-or-later
// The film at the edges of grooves and windows.
#include <algorithm>

#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

// The cell with whose content a layer on the sliding wall is compared: that upstream, or beside a
// groove the one whose gap it fills.
int Reynolds::content_cell(size_t face) const {
  const int upstream = upstream_of(face);
  if (!is(CellKind::kGroove, upstream)) return upstream;
  return upstream == faces_[face].a ? faces_[face].b : faces_[face].a;
}

// Cells reach as far as their part that is not in a recess, whose edge lies between them.
void Reynolds::edge_of_recess(const Face& face, Inside& in) const {
  if (is(CellKind::kOutside, face.a) || is(CellKind::kOutside, face.b)) return;
  const double land_a = 1.0 - stage_.recesses->share[face.a],
               land_b = 1.0 - stage_.recesses->share[face.b];
  if (land_a == 1.0 && land_b == 1.0) return;
  if (land_a < 1.0 && land_b < 1.0) {  // no pressure differs within a recess
    const double between = face.axial ? 0.0 : std::min(land_a, land_b);
    in.length *= between;
    in.length_slope *= between;
    return;
  }
  in.outer_is_b = land_b < land_a;
  in.outer = in.outer_is_b ? land_b : land_a;
  in.outer_slope = 0.0;
  const int n_j = grid_.n_axial(), j_a = face.a % n_j, j_b = face.b % n_j;
  if (!face.axial) {
    in.distance = 0.5 * (land_a * grid_.arc(face.a / n_j) + land_b * grid_.arc(face.b / n_j));
    return;
  }
  const double half_a = 0.5 * land_a * grid_.height(j_a), half_b = 0.5 * land_b * grid_.height(j_b);
  in.distance = half_a * (partial_ ? stage_.cover->share[j_a] : 1.0) +
                half_b * (partial_ ? stage_.cover->share[j_b] : 1.0);
  in.distance_slope = half_a * (partial_ ? stage_.cover->share_slope[j_a] : 0.0) +
                      half_b * (partial_ ? stage_.cover->share_slope[j_b] : 0.0);
}

// States that do not depend on the solution.
void Reynolds::guess_recesses() {
  for (int c = 0; c < grid_.size(); ++c) {
    if (!in_recess(c)) continue;
    const bool full = is(CellKind::kGroove, c) && stage_.recesses->fill[c] == 1.0;
    full_[c] = full ? 1 : 0;
    if (is(CellKind::kGroove, c)) fill_[c] = stage_.recesses->fill[c];
  }
}

void Reynolds::weigh_reservoirs(double mobility) {
  exchange_.setZero();
  if (stage_.recesses == nullptr) return;
  for (int c = 0; c < grid_.size(); ++c) {
    if (!is(CellKind::kBesideGroove, c)) continue;
    const double g = film_.flow_axial[c];
    exchange_[c] = mobility * g * g * g * grid_.arc(c / grid_.n_axial()) /
                   grid_.height(c % grid_.n_axial()) *
                   groove_conductance(stage_.recesses->share[c]) * pressure_scale_ / volume_scale_;
  }
}

// By the gap: what flows into the groove beside a cell; a cell in a groove has what is given.
void Reynolds::add_reservoirs(double mobility, const RowMatrix& dh) {
  const Eigen::Index k = dh.cols();
  for (int c = 0; c < grid_.size(); ++c) {
    auto row = work_.row(row_[c]).head(k);
    if (is(CellKind::kGroove, c)) row.setZero();
    if (!is(CellKind::kBesideGroove, c)) continue;
    const double g = film_.flow_axial[c];
    row -= mobility * 3.0 * g * g * film_.d_flow_axial[c] * grid_.arc(c / grid_.n_axial()) /
           grid_.height(c % grid_.n_axial()) * groove_conductance(stage_.recesses->share[c]) *
           (pressure_[c] - stage_.recesses->pressure[c]) * dh.row(c);
  }
}

}  // namespace clatter::film
