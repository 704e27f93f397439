// SPDX-License-Identifier: GPL-3.0-or-later
// Oil on the faces: the limited profile between cells, and outflow that a cell can supply.
#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/film/reynolds.hpp"

namespace clatter::film {
namespace {

// Outflow exceeds what a cell holds by more than the rounding of its sums.
constexpr double kRounding = 1e-14;

}  // namespace

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

// theta + l (1 - theta) meets its bound, 2 theta for l > 0 and 0 for l < 0, at |l| / (1 + |l|).
double Reynolds::lowest_lifted(size_t face) const {
  const double size = std::abs(lift_[face]);
  return size / (1.0 + size);
}

Reynolds::FaceFill Reynolds::face_fill(size_t face) const {
  const double l = lift_[face];
  if (limited_[face] == 0) return {l, 1.0};
  return {0.0, l > 0.0 ? 2.0 : 0.0};
}

double Reynolds::fill_on_face(size_t face) const {
  const int upstream = upstream_of(face);
  const double theta = fill_[upstream];
  if (is_full(upstream) || limited_[face] == 0) return theta + lift_[face] * (1.0 - theta);
  return face_fill(face).full * theta;
}

// In each pass a cell gives at most what it held and what the pass before let in: flows only fall.
void Reynolds::limit_outflow(const Eigen::ArrayXd& content, Eigen::ArrayXd& sent,
                             Eigen::ArrayXd& before) const {
  // Donor and receiver of face or edge `k`; -1 is outside.
  auto ends = [&](Eigen::Index k) -> std::pair<int, int> {
    const auto at = static_cast<size_t>(k);
    const bool inside = at < faces_.size();
    const int from = inside ? faces_[at].a : rims_[at - faces_.size()].cell;
    const int to = inside ? faces_[at].b : -1;
    return sent[k] > 0.0 ? std::pair{from, to} : std::pair{to, from};
  };
  Eigen::ArrayXd held, leaving, share;
  for (;;) {
    held = content * grid_.area();
    leaving.setZero(grid_.size());
    for (Eigen::Index k = 0; k < sent.size(); ++k) {
      const auto [donor, receiver] = ends(k);
      if (donor >= 0) leaving[donor] += std::abs(sent[k]);
      if (receiver >= 0) held[receiver] += std::abs(sent[k]);
    }
    if (!(leaving > held * (1.0 + kRounding)).any()) break;
    share = (leaving > held).select(held / leaving, 1.0);
    for (Eigen::Index k = 0; k < sent.size(); ++k)
      if (const int donor = ends(k).first; donor >= 0) sent[k] *= share[donor];
  }
  before = (held - leaving).max(0.0) / grid_.area();
}

}  // namespace clatter::film
