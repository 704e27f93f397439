// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/film_extent.hpp"

#include <algorithm>

namespace clatter::film {

// The less covered cell's value counts in proportion to its cover: none at all for one outside,
// whose gap may be closed.
std::pair<double, double> OpenPart::beside(double a, double b) const {
  if (outer == 1.0) return {a, b};
  if (outer_is_b) return {a, a + outer * (b - a)};
  return {b + outer * (a - b), b};
}

void OpenPart::to_cells(double& by_a, double& by_b) const {
  if (outer == 1.0) return;
  double &by_outer = outer_is_b ? by_b : by_a, &by_inner = outer_is_b ? by_a : by_b;
  by_inner += (1.0 - outer) * by_outer;
  by_outer *= outer;
}

void FilmExtent::set(const Cover* cover, const RecessCells* recesses) {
  cover_ = cover;
  recesses_ = recesses;
  partial_ = cover != nullptr && (cover->share < 1.0).any();
  kind_.resize(grid_.size());
  for (int c = 0; c < grid_.size(); ++c) kind_[c] = kind_of(c);
}

CellKind FilmExtent::kind_of(int cell) const {
  if (partial_ && cover_->share[cell % grid_.n_axial()] == 0.0) return CellKind::kOutside;
  if (recesses_ == nullptr || recesses_->share[cell] == 0.0) return CellKind::kFilm;
  if (!recesses_->covered(cell)) return CellKind::kBesideGroove;
  return recesses_->window[cell] ? CellKind::kWindow : CellKind::kGroove;
}

OpenPart FilmExtent::open(const Face& face) const {
  OpenPart part = covered_part(face);
  if (recesses_ != nullptr) end_at_recess(face, part);
  return part;
}

OpenPart FilmExtent::covered_part(const Face& face) const {
  OpenPart part{.distance = face.distance};
  if (!partial_) return part;
  const Cover& cover = *cover_;
  const int j_a = face.a % grid_.n_axial(), j_b = face.b % grid_.n_axial();
  const double w_a = cover.share[j_a], w_b = cover.share[j_b];
  const double d_a = cover.share_slope[j_a], d_b = cover.share_slope[j_b];
  if (!face.axial) {
    part.length = part.carried = w_a;
    part.length_slope = part.carried_slope = d_a;
    return part;
  }
  if (w_a == 0.0 && w_b == 0.0) {
    part.length = part.carried = 0.0;
    return part;
  }
  part.carried = cover.edge[j_b];
  part.carried_slope = cover.edge_slope[j_b];
  part.distance = 0.5 * (w_a * grid_.height(j_a) + w_b * grid_.height(j_b));
  part.distance_slope = 0.5 * (d_a * grid_.height(j_a) + d_b * grid_.height(j_b));
  part.outer_is_b = w_b <= w_a;
  part.outer = part.outer_is_b ? w_b / w_a : w_a / w_b;
  part.outer_slope =
      part.outer_is_b ? (d_b - part.outer * d_a) / w_a : (d_a - part.outer * d_b) / w_b;
  return part;
}

// Cells reach as far as their part that is not in a recess, whose edge lies between them.
void FilmExtent::end_at_recess(const Face& face, OpenPart& part) const {
  if (is(CellKind::kOutside, face.a) || is(CellKind::kOutside, face.b)) return;
  const double land_a = 1.0 - recesses_->share[face.a], land_b = 1.0 - recesses_->share[face.b];
  if (land_a == 1.0 && land_b == 1.0) return;
  if (land_a < 1.0 && land_b < 1.0) {  // no pressure differs within a recess
    const double between = face.axial ? 0.0 : std::min(land_a, land_b);
    part.length *= between;
    part.length_slope *= between;
    return;
  }
  part.outer_is_b = land_b < land_a;
  part.outer = part.outer_is_b ? land_b : land_a;
  part.outer_slope = 0.0;
  const int n_j = grid_.n_axial(), j_a = face.a % n_j, j_b = face.b % n_j;
  if (!face.axial) {
    part.distance = 0.5 * (land_a * grid_.arc(face.a / n_j) + land_b * grid_.arc(face.b / n_j));
    return;
  }
  const double half_a = 0.5 * land_a * grid_.height(j_a), half_b = 0.5 * land_b * grid_.height(j_b);
  part.distance = half_a * (partial_ ? cover_->share[j_a] : 1.0) +
                  half_b * (partial_ ? cover_->share[j_b] : 1.0);
  part.distance_slope = half_a * (partial_ ? cover_->share_slope[j_a] : 0.0) +
                        half_b * (partial_ ? cover_->share_slope[j_b] : 0.0);
}

OpenPart FilmExtent::open(const Rim& rim) const {
  OpenPart part{.distance = rim.distance};
  if (!partial_) return part;
  const Cover& cover = *cover_;
  const int j = rim.cell % grid_.n_axial();
  if (!rim.axial || cover.share[j] == 0.0) {
    part.length = part.carried = cover.share[j];
    part.length_slope = part.carried_slope = cover.share_slope[j];
    return part;
  }
  const int edge = rim.sign < 0.0 ? j : j + 1;
  part.distance = cover.share[j] * rim.distance;
  part.distance_slope = cover.share_slope[j] * rim.distance;
  part.carried = cover.edge[edge];
  part.carried_slope = cover.edge_slope[edge];
  return part;
}

}  // namespace clatter::film
