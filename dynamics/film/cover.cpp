// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

// A row that is covered less than this counts as outside: its film would end within a billionth of
// its height from its centre.
constexpr double kOutside = 1e-9;

struct Step {
  double integral, value, slope;  // of S
};

Step smooth_step(double x) {
  if (x <= 0.0) return {0.0, 0.0, 0.0};
  if (x >= 1.0) return {x - 0.5, 1.0, 0.0};
  return {x * x * x * (1.0 - 0.5 * x), x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x)};
}

}  // namespace

CoverMap::CoverMap(const LinerEnds& ends, const PadGrid& pad)
    : ends_(ends),
      edges_(pad.axial_edges()),
      width_((edges_[edges_.size() - 1] - edges_[0]) / pad.n_axial()) {
  if (!(ends.top - ends.bottom >= 2.0 * width_))
    throw InputError(fmt::format(
        "liner: found ends at {:.6g} and {:.6g} m, expected the top at least two rows of cells, "
        "{:.3g} m, above the bottom",
        ends.bottom, ends.top, 2.0 * width_));
}

void CoverMap::at(double height, Cover& cover) const {
  const Eigen::Index rows = edges_.size() - 1;
  for (Eigen::ArrayXd* values : {&cover.share_slope, &cover.share_curve}) values->setZero(rows);
  cover.share.setOnes(rows);
  cover.edge.setOnes(rows + 1);
  cover.edge_slope.setZero(rows + 1);
  // `sign`: direction from the end into the liner.
  auto cut = [&](double end, double sign) {
    if (std::isinf(end)) return;
    auto at_edge = [&](Eigen::Index k) {
      return smooth_step(sign * (edges_[k] + height - end) / width_ + 0.5);
    };
    Step low = at_edge(0);
    for (Eigen::Index k = 0; k <= rows; ++k) {
      cover.edge[k] += low.value - 1.0;
      cover.edge_slope[k] += sign * low.slope / width_;
      if (k == rows) break;
      const Step high = at_edge(k + 1);
      if (std::min(low.value, high.value) < 1.0) {
        const double row = edges_[k + 1] - edges_[k];
        cover.share[k] += sign * (high.integral - low.integral) * width_ / row - 1.0;
        cover.share_slope[k] += (high.value - low.value) / row;
        cover.share_curve[k] += sign * (high.slope - low.slope) / (row * width_);
      }
      low = high;
    }
  };
  cut(ends_.bottom, 1.0);
  cut(ends_.top, -1.0);
  for (Eigen::Index k = 0; k < rows; ++k)
    if (cover.share[k] < kOutside)
      cover.share[k] = cover.share_slope[k] = cover.share_curve[k] = 0.0;
}

}  // namespace clatter::film
