// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/clearance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/units.hpp"
#include "dynamics/cylinder/cylinder_catalogue.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kSearchDeg = 0.1;

/// Angle after TDC, within the down stroke, at which the pin is at a height [deg].
double angle_of_pin(const SliderCrank& crank, double height) {
  double nearest = 0.0, off = std::numeric_limits<double>::infinity();
  for (double at = -30.0; at <= 210.0; at += kSearchDeg) {
    const double found = std::abs(crank.piston_pin(crank.time(at * kDegree)).position - height);
    if (found < off) {
      nearest = at;
      off = found;
    }
  }
  return nearest;
}

}  // namespace

void set_stroke(const SliderCrank& crank, film::WarmClearance& warm) {
  const double e = crank.pin_offset(), l = crank.rod_length(), r = crank.radius();
  warm.lowest_pin = std::sqrt((l - r) * (l - r) - e * e);
  warm.highest_pin = std::sqrt((l + r) * (l + r) - e * e);
}

void add_clearance_effect(const std::string& cylinder, const SliderCrank& crank,
                          const film::PistonLinerOptions& contact, EffectTable& effects) {
  const EffectEntry* entry = find_effect(kCylinderEffects, "minimum warm clearance");
  const std::string effect = (cylinder.empty() ? "" : cylinder + ": ") + std::string(entry->name);
  if (!contact.warm_clearance) {
    effects.add(entry, effect, false, "contact.clearance_um is given instead");
    return;
  }
  const film::NearestPoint at = film::nearest_point(contact, *contact.warm_clearance);
  effects.add(
      entry, effect, true,
      fmt::format("contact.minimum_warm_clearance_um: {:.4g} um of clearance between the cold "
                  "surfaces, smallest warm gap {:.3g} mm above the pin, {:.0f} deg around, {:.0f} "
                  "deg after TDC",
                  contact.clearance / kMicro, at.height / kMilli,
                  std::round(at.angle / kDegree) + 0.0, angle_of_pin(crank, at.pin)));
}

}  // namespace clatter::dynamics
