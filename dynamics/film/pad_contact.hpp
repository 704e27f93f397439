// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Asperity pressure on one pad, elastic or damped.
#include <Eigen/Core>

#include "dynamics/film/pad_gap.hpp"

namespace clatter::film {

/// p_c of the cells of a pad, n, with its derivatives: asperity pressure p_a(h) times the ratio of
/// contact_damping.hpp. Nothing in recesses.
class PadContact {
 public:
  /// `model` has asperities, and is read while this is used.
  PadContact(const ContactModel& model, int cells);
  void set(const PadGap& gap, const PadState& state);

  const Eigen::ArrayXd& pressure() const { return pressure_; }      // p_c [Pa]
  const Eigen::ArrayXd& elastic() const { return elastic_; }        // p_a [Pa]
  const Eigen::ArrayXd& slope() const { return slope_; }            // dp_c/dh [Pa/m]
  const Eigen::ArrayXd& rate_slope() const { return rate_slope_; }  // dp_c/dh' [Pa s/m]; or empty

  /// Force along the stroke on the piston where asperities are pressed together as a row slides in
  /// over the end of the liner [N]: minus the derivative of their energy by height.
  double end_force(const PadGap& gap) const;
  /// Its derivative by height at a fixed gap [N/m].
  double end_slope(const PadGap& gap) const;

  /// Stored [J].
  double energy(const PadGap& gap) const { return (gap.area() * energy_).sum(); }
  /// Power lost to damping [W].
  double lost(const PadGap& gap) const { return (gap.area() * loss_).sum(); }
  /// Force along the stroke that presses asperities together which slide over the edges of the
  /// liner's grooves [N].
  double groove_force(const PadGap& gap) const;

 private:
  void damp(const PadGap& gap, const PadState& state);

  const Asperity& asperity_;
  const std::optional<ContactDamping>& damping_;
  Eigen::ArrayXd pressure_, slope_, elastic_, energy_;  // energy [J/m2]
  Eigen::ArrayXd rate_slope_, loss_;                    // loss [W/m2]; empty: elastic
};

}  // namespace clatter::film
