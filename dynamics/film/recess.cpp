// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/recess.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::film {
namespace {

// Less of a row than this is none, more than its complement all: the conductance beside the edge
// stays finite.
constexpr double kNarrow = 1e-6;

}  // namespace

bool has_grooves(const std::vector<Recess>& recesses) {
  return std::any_of(recesses.begin(), recesses.end(),
                     [](const Recess& one) { return one.kind == Recess::Kind::kGroove; });
}

RecessMap::RecessMap(std::vector<Recess> recesses, const PadGrid& pad)
    : recesses_(std::move(recesses)), pad_(pad) {}

bool RecessMap::has_column(const Recess& recess, int i) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double past = pad_.angle(i) - recess.angle_begin;
  return past - kTurn * std::floor(past / kTurn) < recess.angle_span;
}

int RecessMap::cells_of(size_t k) const {
  const Recess& recess = recesses_[k];
  int columns = 0, rows = recess.on_liner ? 1 : 0;
  for (int i = 0; i < pad_.n_angle(); ++i) columns += has_column(recess, i);
  for (int j = 0; !recess.on_liner && j < pad_.n_axial(); ++j)
    rows += pad_.axial(j) > recess.bottom && pad_.axial(j) < recess.top;
  return columns * rows;
}

void RecessMap::at(double height, RecessCells& cells) const {
  const int n = pad_.size();
  for (Eigen::ArrayXd* values : {&cells.share, &cells.share_slope, &cells.pressure, &cells.fill})
    values->setZero(n);
  cells.window.setConstant(n, false);
  for (const Recess& recess : recesses_)
    for (int j = 0; j < pad_.n_axial(); ++j) {
      double share = 0.0, slope = 0.0;
      if (recess.on_liner) {
        const double row = pad_.height(j), low = pad_.axial_edges()[j] + height, high = low + row;
        share = (std::min(high, recess.top) - std::max(low, recess.bottom)) / row;
        slope = (low < recess.bottom ? 1.0 : 0.0) - (high > recess.top ? 1.0 : 0.0);
        slope /= row;
      } else {
        share = pad_.axial(j) > recess.bottom && pad_.axial(j) < recess.top ? 1.0 : 0.0;
      }
      if (share < kNarrow) continue;
      if (share > 1.0 - kNarrow) {
        share = 1.0;
        slope = 0.0;
      }
      for (int i = 0; i < pad_.n_angle(); ++i) {
        const int c = pad_.cell(i, j);
        if (share <= cells.share[c] || !has_column(recess, i)) continue;
        cells.share[c] = share;
        cells.share_slope[c] = slope;
        cells.pressure[c] = recess.pressure;
        cells.fill[c] = recess.fill;
        cells.window[c] = recess.kind == Recess::Kind::kWindow;
      }
    }
}

}  // namespace clatter::film
