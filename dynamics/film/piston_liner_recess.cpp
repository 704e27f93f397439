// SPDX-License-Identifier: GPL-3.0-or-later
// Grooves and windows of the piston-liner contact.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "dynamics/film/pad_state.hpp"

namespace clatter::film {
namespace {

// A window is so much deeper than the gap [m]: no layer fills it.
constexpr double kWindowDepth = 1e-3;
// Least thickness in a recess [m]: the surfaces that it interrupts may cross.
constexpr double kLeastGap = 1e-7;

}  // namespace

bool has_grooves(const PistonLinerOptions& options) {
  return std::any_of(options.recesses.begin(), options.recesses.end(),
                     [](const Recess& one) { return one.kind == Recess::Kind::kGroove; });
}

void PistonLiner::check_recesses() const {
  const double row = (options_.skirt_top - options_.skirt_bottom) / options_.cells_along;
  for (size_t k = 0; k < options_.recesses.size(); ++k) {
    const Recess& one = options_.recesses[k];
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}: recess {}: {}", options_.name, k + 1, what));
    };
    if (!(one.pressure >= 0.0)) fail(fmt::format("found {} Pa, expected >= 0", one.pressure));
    if (!(one.fill >= 0.0 && one.fill <= 1.0))
      fail(fmt::format("found a fill of {}, expected 0 to 1", one.fill));
    if (one.pressure > 0.0 && one.fill < 1.0)
      fail(fmt::format("found a fill of {} under pressure, expected 1", one.fill));
    if (one.kind == Recess::Kind::kWindow && one.on_liner)
      fail("found a window of the liner, expected a groove: with fill 0 for a port");
    if (one.on_liner && !(one.top - one.bottom >= row))
      fail(fmt::format("found a height of {:.4g} m, expected at least a row of cells, {:.4g} m",
                       one.top - one.bottom, row));
    int cells = 0;
    for (const auto& pad : pads_) cells += pad->recesses->map.cells_of(k);
    if (cells == 0)
      fail("the recess covers no cell: it is smaller than a cell or outside the pads");
  }
}

void PistonLiner::add_recesses(Pad& pad) {
  std::vector<Recess> recesses = options_.recesses;
  bool moves = false;
  for (Recess& one : recesses) {
    if (viscosity_) one.pressure = viscosity_->reduced(one.pressure);
    moves = moves || one.on_liner;
  }
  pad.recesses.emplace(PadRecesses{RecessMap(std::move(recesses), pad.grid), moves, {}});
  RecessCells& cells = pad.recesses->cells;
  pad.recesses->map.at(0.0, cells);
  for (Eigen::Index c = 0; c < pad.rest.size(); ++c)
    if (cells.open(c)) pad.rest[c] += kWindowDepth;
}

// Grooves of the liner move with the ideal stroke alone: a cell does not change between land and
// groove while a stage is solved.
void PistonLiner::place_recesses(Pad& pad, double position) const {
  RecessCells& cells = pad.recesses->cells;
  if (pad.recesses->moves) pad.recesses->map.at(position, cells);
  for (Eigen::Index c = 0; c < pad.gap.size(); ++c)
    if (cells.covered(c) && pad.gap[c] < kLeastGap) pad.gap[c] = kLeastGap;
}

// Power that presses asperities together which slide over the edges of the liner's grooves [W].
double PistonLiner::recess_power(const Pad& pad) const {
  double power = 0.0;
  const RecessCells& cells = pad.recesses->cells;
  for (Eigen::Index c = 0; c < pad.gap.size(); ++c)
    if (cells.share_slope[c] != 0.0)
      power -= pad.area[c] * cells.share_slope[c] * asperity_->at(pad.gap[c]).energy;
  return power * ideal_.velocity;
}

}  // namespace clatter::film
