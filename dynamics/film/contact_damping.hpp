// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Damping of the asperity contact by a loss factor.

namespace clatter::film {

struct ContactDampingOptions {
  /// eta of the contact normal to the surfaces [1], 0 to 0.6; 0: elastic, nothing is computed.
  /// Metal structures with joints have damping ratios of 0.03 to 0.07, those without 0.02 to 0.04
  /// (Adams and Askenazi 1999); a loss factor is twice the ratio.
  double loss_factor = 0.05;
  double speed = 1e-2;  // v_0, below which the damping is viscous [m/s]
};

/// Ratio of the pressure of rough surfaces to that of the elastic contact at the same gap:
///
///   p = p_a(h) (1 - a w),   w = h' / sqrt(h'^2 + v_0^2),   a = pi eta / 2
///
/// h' is the rate of the gap. Since a |w| < 1 the contact never pulls, and force and tangent are
/// smooth. It loses p_a a w h' >= 0 [W/m2]. A mass that bounces at speed v_i leaves at v_o with
///
///   int_0^v_i u du / (1 + a w(u)) = int_0^v_o u du / (1 - a w(u)),
///
/// whatever p_a(h) is: one loss factor gives the same restitution for every law and roughness.
/// - v_i much above v_0: e = sqrt((1 - a) / (1 + a)) = 1 - a, at every speed. Loading and unloading
///   lose 2 a of the energy stored, which is that of half a period of a linear spring with the
///   same loss factor. Internal friction of metals does not depend on the rate (Kimball and
///   Lovell 1927), nor does that of joints; 0.05 gives e = 0.92.
/// - v_i much below v_0: p = p_a (1 - chi h') with chi = a / v_0 (Hunt and Crossley 1975),
///   e = 1 - alpha v_i, alpha = 2 chi / 3. At all speeds, this law loses in proportion to the
///   speed: their alpha of steel and bronze, 0.08 to 0.32 s/m, makes e 0.92 to 0.98 at the slap's
///   0.25 m/s but leaves the bounces after it undamped, and one that damps these makes the slap
///   plastic.
/// v_0 of 10 mm/s is below the slap's bounces, and above small vibration under load, which then
/// has the loss factor of a viscous contact, 2 pi f chi p_a / |dp_a/dh|: about eta at 5 kHz.
class ContactDamping {
 public:
  struct Ratio {
    double value;  // p / p_a [1], between 1 - a and 1 + a
    double slope;  // its derivative by h' [s/m], <= 0
  };
  /// InputError unless 0 <= loss_factor <= 0.6 and speed > 0.
  explicit ContactDamping(const ContactDampingOptions& options);

  /// At the rate `gap_rate` of the gap [m/s], negative when closing.
  Ratio at(double gap_rate) const;

 private:
  double amplitude_;  // a [1]
  double speed_;      // v_0 [m/s]
};

}  // namespace clatter::film
