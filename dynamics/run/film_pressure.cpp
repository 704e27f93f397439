// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/film_pressure.hpp"

#include <fmt/format.h>

#include <numbers>

#include "dynamics/run/run_clock.hpp"

namespace clatter::dynamics {
namespace {

std::string position_of_largest(const film::PistonLiner& contact) {
  const film::PadSnapshot* pad = nullptr;
  Eigen::Index around = 0, along = 0;
  double largest = 0.0;
  const std::vector<film::PadSnapshot> pads = contact.snapshot();
  for (const film::PadSnapshot& one : pads) {
    Eigen::Index i = 0, j = 0;
    if (one.pressure.size() == 0 || one.pressure.maxCoeff(&i, &j) <= largest) continue;
    pad = &one;
    around = i;
    along = j;
    largest = one.pressure(i, j);
  }
  if (pad == nullptr) return "the skirt";
  return fmt::format("the {} side at {:.1f} deg, {:.1f} mm from the pin", pad->name,
                     pad->angle[around] * 180.0 / std::numbers::pi, 1e3 * pad->axial[along]);
}

size_t entry_of_pressure(const History& scalars) {
  const auto& entries = scalars.entries();
  size_t k = 0;
  while (k < entries.size() && entries[k].name != "film_pressure_max") ++k;
  return k;
}

}  // namespace

void FilmPressureWatch::look(const Model& model, const History& scalars, double time) {
  if (model.contact == nullptr) return;
  if (!entry_) entry_ = entry_of_pressure(scalars);
  if (*entry_ == scalars.entries().size()) return;
  const double pressure = scalars.entries()[*entry_].value;
  if (!(pressure > largest_)) return;
  largest_ = pressure;
  warning_ = {fmt::format(
      "film pressure {:.3g} GPa at crank angle {:.1f} deg on {} is above {:.3g} GPa, which neither "
      "oil nor skirt bear as modelled: reduce the speed or the clearance, or use elastic bodies",
      1e-9 * pressure, crank_angle_deg(model, time), position_of_largest(*model.contact),
      1e-9 * kLargestFilmPressure)};
}

}  // namespace clatter::dynamics
