// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/film_pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/film/piston_liner.hpp"

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
  return fmt::format("the {} at {:.1f} deg, {:.1f} mm from the pin",
                     pad->name == "skirt" ? pad->name : pad->name + " side",
                     pad->angle[around] * 180.0 / std::numbers::pi, 1e3 * pad->axial[along]);
}

size_t entry_of(const History& scalars, const std::string& component, const std::string& name) {
  const auto& entries = scalars.entries();
  const std::string complete = component.empty() ? name : component + "_" + name;
  size_t k = 0;
  while (k < entries.size() && entries[k].name != complete) ++k;
  return k;
}

/// The pin's six coordinates alone: neither skirt nor liner is elastic.
bool is_rigid(const film::PistonLiner& contact) { return contact.size() == 6; }

}  // namespace

void FilmPressureWatch::look(const Model& model, const History& scalars, double time) {
  if (!watched_) {
    watched_.emplace();
    for (const auto& [name, contact] : contacts_of(model)) {
      const size_t pressure = entry_of(scalars, name, "film_pressure_max"),
                   force = entry_of(scalars, name, "side_force");
      if (std::max(pressure, force) < scalars.entries().size())
        watched_->push_back({name, contact, pressure, force});
    }
  }
  for (Watched& one : *watched_) {
    const double pressure = scalars.entries()[one.pressure].value;
    if (!(pressure > one.largest)) continue;
    one.largest = pressure;
    one.warning = fmt::format(
        "{}film pressure {:.3g} GPa at crank angle {:.1f} deg on {} is above {:.3g} GPa, which "
        "neither oil nor skirt bear as modelled, under a side force of {:.3g} N: reduce the loads "
        "on "
        "the piston, the speed or the clearance{}",
        one.name.empty() ? "" : one.name + ": ", 1e-9 * pressure, model.clock->angle_deg(time),
        position_of_largest(*one.contact), 1e-9 * kLargestFilmPressure,
        std::abs(scalars.entries()[one.force].value),
        is_rigid(*one.contact) ? ", or use elastic bodies" : "");
  }
}

std::vector<std::string> FilmPressureWatch::warnings() const {
  std::vector<std::string> found;
  if (!watched_) return found;
  for (const Watched& one : *watched_)
    if (!one.warning.empty()) found.push_back(one.warning);
  return found;
}

}  // namespace clatter::dynamics
