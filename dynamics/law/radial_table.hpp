// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The force in a joint as a table over its eccentricity.
#include <utility>
#include <variant>

#include "dynamics/given/rising_table.hpp"
#include "dynamics/law/radial_law.hpp"

namespace clatter::dynamics {

/// Force F(e) of a table and damping c(e), constant or of a table with constant ends. The stored
/// energy is the exact integral of F, so the law makes and loses no energy.
class RadialTable {
 public:
  /// @param force over the eccentricity. @param damping over the eccentricity [N s/m], not
  /// negative.
  RadialTable(RisingTable force, Spline damping)
      : force_(std::move(force)), damping_(std::move(damping)) {}
  RadialTable(RisingTable force, double damping)
      : RadialTable(std::move(force), Spline(Spline::Kind::kLinear, {0.0}, {damping})) {}

  double force(double e) const { return force_.value(e); }            // [N]
  double slope(double e) const { return force_.slope(e); }            // dF/de [N/m]
  double energy(double e) const { return force_.integral(e); }        // [J]
  double damping_at(double e) const { return damping_(e); }           // c [N s/m]
  double damping_slope(double e) const { return damping_.slope(e); }  // dc/de [N s/m2]

 private:
  RisingTable force_;
  Spline damping_;
};

/// What a joint of two points does over its eccentricity.
using RadialForce = std::variant<RadialLaw, RadialTable>;

/// A joint law at one eccentricity.
struct RadialPoint {
  double force, slope;            // F [N], dF/de [N/m]
  double damping, damping_slope;  // c [N s/m], dc/de [N s/m2]
};
inline RadialPoint radial_point(const RadialForce& law, double e) {
  return std::visit(
      [e](const auto& of) {
        return RadialPoint{of.force(e), of.slope(e), of.damping_at(e), of.damping_slope(e)};
      },
      law);
}
/// Stored energy [J].
inline double radial_energy(const RadialForce& law, double e) {
  return std::visit([e](const auto& of) { return of.energy(e); }, law);
}

}  // namespace clatter::dynamics
