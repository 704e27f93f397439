// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/warm_clearance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/film/piston_liner_options.hpp"

namespace clatter::film {
namespace {

constexpr double kAlong = 1e-3;            // of the samples [m]
constexpr double kAround = 2.0 * kDegree;  // [rad]

/// Number of steps of at most `step` in a range; at least one.
int steps(double range, double step) {
  return std::max(1, static_cast<int>(std::ceil(range / step - 1e-9)));
}

/// Samples at the centres of cells; an odd number around, so that the middle is among them.
PadGrid samples(const PistonLinerOptions& o, double centre) {
  // The entire skirt as two halves.
  const double span = o.span == SkirtSpan::kWhole ? std::numbers::pi : o.pad_span;
  const int half = steps(0.5 * span, kAround);
  return PadGrid::uniform(centre - 0.5 * span, centre + 0.5 * span, 2 * half + 1, o.skirt_bottom,
                          o.skirt_top, steps(o.skirt_top - o.skirt_bottom, kAlong), o.bore_radius);
}

/// One pad: what of the gap moves with the skirt, and the shapes of the liner.
struct SampledPad {
  SampledPad(const PistonLinerOptions& o, double centre)
      : grid(samples(o, centre)), skirt(skirt_relief(o.skirt, grid)), liner(grid.size()) {
    Eigen::ArrayXd outward = Eigen::ArrayXd::Zero(grid.size()), slope = outward;
    for (const LinerShape& shape : o.skirt_shapes)
      LinerShapeMap(shape, grid).add(0.0, outward, slope);
    skirt -= outward;
    if (o.bore) shapes.emplace_back(*o.bore, grid);
    for (const LinerShape& shape : o.bore_shapes) shapes.emplace_back(shape, grid);
    is_deep.setConstant(grid.size(), false);
    std::vector<Recess> recesses = o.recesses;
    std::erase_if(recesses, [](const Recess& recess) { return recess.on_liner; });
    if (recesses.empty()) return;
    RecessCells cells;
    RecessMap(std::move(recesses), grid).at(0.0, cells);
    is_deep = cells.share == 1.0;
  }

  void find_nearest(double pin, const LinerEnds& ends, NearestPoint& nearest) {
    liner.setZero();
    Eigen::ArrayXd slope = liner;
    for (const LinerShapeMap& shape : shapes) shape.add(pin, liner, slope);
    for (int j = 0; j < grid.n_axial(); ++j) {
      const double height = grid.axial(j);
      if (pin + height < ends.bottom || pin + height > ends.top) continue;
      for (int i = 0; i < grid.n_angle(); ++i) {
        if (is_deep[grid.cell(i, j)]) continue;
        const double gap = skirt[grid.cell(i, j)] + liner[grid.cell(i, j)];
        if (gap < nearest.gap) nearest = {gap, grid.angle(i), height, pin};
      }
    }
  }

  PadGrid grid;
  Eigen::ArrayXd skirt, liner;
  Eigen::Array<bool, Eigen::Dynamic, 1> is_deep;  // in a groove or window of the skirt
  std::vector<LinerShapeMap> shapes;
};

}  // namespace

NearestPoint nearest_point(const PistonLinerOptions& options, const WarmClearance& warm) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  NearestPoint nearest{kNone, 0.0, 0.0, 0.0};
  std::vector<SampledPad> pads{{options, 0.0}, {options, std::numbers::pi}};
  const double stroke = warm.highest_pin - warm.lowest_pin;
  const int count = steps(stroke, kAlong);
  for (int k = 0; k <= count; ++k)
    for (SampledPad& pad : pads)
      pad.find_nearest(warm.lowest_pin + stroke * k / count, options.ends, nearest);
  if (nearest.gap == kNone)
    throw InputError(fmt::format(
        "minimum_warm_clearance_um: found a skirt outside of the liner from {:g} to {:g} mm over "
        "the entire stroke, expected one inside",
        options.ends.bottom / kMilli, options.ends.top / kMilli));
  return nearest;
}

}  // namespace clatter::film
