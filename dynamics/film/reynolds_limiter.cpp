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

// Excess on a face over the upstream cell: of the fill, as a fraction of the unfilled part of that
// cell, or of a layer, as a fraction of the layer.
double Reynolds::lift(const Face& face, double speed) const {
  const Eigen::ArrayXd* profile = stage_.profile_before;
  if (profile == nullptr || speed == 0.0) return 0.0;
  const int upstream = speed > 0.0 ? face.a : face.b, downstream = speed > 0.0 ? face.b : face.a;
  const int beyond = speed > 0.0 ? face.beyond_a : face.beyond_b;
  const double here = (*profile)[upstream], whole = layers() ? here : 1.0 - here;
  if (beyond < 0 || whole <= 0.0 || is(CellKind::kOutside, beyond) ||
      is(CellKind::kOutside, downstream))
    return 0.0;
  if (in_recess(upstream) || in_recess(beyond) || in_recess(downstream)) return 0.0;
  const double up = here - (*profile)[beyond], down = (*profile)[downstream] - here;
  if (up * down <= 0.0) return 0.0;
  return std::clamp(up * down / (up + down) / whole, -1.0, 1.0);
}

// theta + l (1 - theta) meets its bound, 2 theta for l > 0 and 0 for l < 0, at |l| / (1 + |l|).
double Reynolds::lowest_lifted(size_t face) const {
  const double size = std::abs(lift_[face]);
  return size / (1.0 + size);
}

Reynolds::FaceFill Reynolds::face_fill(size_t face) const {
  const bool limited = limited_[face] != 0;
  if (layers()) return limited ? FaceFill{1.0, 1.0} : FaceFill{0.0, ratio_[face]};
  const double l = lift_[face];
  if (!limited) return {l, 1.0};
  return {0.0, l > 0.0 ? 2.0 : 0.0};
}

double Reynolds::fill_on_face(size_t face) const {
  const int upstream = upstream_of(face);
  if (is_full(upstream)) return 1.0;
  const FaceFill law = face_fill(face);
  return law.empty + (law.full - law.empty) * fill_[upstream];
}

double Reynolds::fill_on_rim(size_t rim) const {
  const int cell = rims_[rim].cell;
  return is_full(cell) || rim_limited_[rim] != 0 ? 1.0 : rim_ratio_[rim] * fill_[cell];
}

// Thickness that U_m carries in over an edge [m], with its slope by the gap.
ValueSlope Reynolds::entering(const Edge& edge, int cell) const {
  const double carry = film_.carry[cell], d_carry = film_.d_carry[cell];
  ValueSlope least{edge.fill * carry, edge.fill * d_carry};
  auto bound = [&least](double value, double slope) {
    if (value < least.value) least = {value, slope};
  };
  if (layers()) {
    least = {carry, d_carry};
    bound(2.0 * edge.fill * film_.content[cell], 2.0 * edge.fill * film_.d_content[cell]);
  }
  bound(2.0 * edge.layer, 0.0);
  return least;
}

Eigen::ArrayXd Reynolds::profile() const {
  if (!layers()) return fill_;
  return (fill_ * film_.content).min(0.5 * film_.carry);
}

ValueSlope Reynolds::sheared(int cell) const {
  if (in_recess(cell)) return {0.0, 0.0};
  const double land = is(CellKind::kBesideGroove, cell) ? 1.0 - stage_.recesses->share[cell] : 1.0;
  if (is_full(cell) || !layers()) return {land * fill_[cell], is_full(cell) ? 0.0 : land};
  const bool both_walls = fill_[cell] > 0.5;
  return {both_walls ? land * (2.0 * fill_[cell] - 1.0) : 0.0, both_walls ? land * 2.0 : 0.0};
}

// In each pass a cell gives at most what it held and what the pass before let in: flows only fall.
void Reynolds::limit_outflow(const Eigen::ArrayXd& content, Eigen::ArrayXd& sent,
                             Eigen::ArrayXd& before) const {
  // Donor and receiver of face, edge or end `k`; -1 is outside.
  auto ends = [&](Eigen::Index k) -> std::pair<int, int> {
    const auto at = static_cast<size_t>(k);
    const bool inside = at < faces_.size();
    const int from = inside ? faces_[at].a
                     : at < faces_.size() + rims_.size()
                         ? rims_[at - faces_.size()].cell
                         : static_cast<int>(at - faces_.size() - rims_.size()) % grid_.size();
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
