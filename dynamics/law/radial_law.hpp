// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The force in a pin joint with clearance over its eccentricity.

namespace clatter::dynamics {

/// Soft inside the clearance, stiff beyond, continuous with its derivative:
///   F(e) = k_s e + k <e - c>,  <x> = x^n for n > 1 (n = 1: x^2 / (2 w) up to w, then x - w / 2).
struct RadialLaw {
  double clearance = 1e-5;      // c [m]
  double soft_stiffness = 1e7;  // k_s [N/m]
  double stiffness = 1e9;       // k [N/m^n]
  double exponent = 1.0;        // n >= 1
  double damping = 1e4;         // linear on the relative velocity [N s/m]

  double force(double e) const;                        // [N]
  double slope(double e) const;                        // dF/de [N/m]
  double energy(double e) const;                       // integral of F from 0 [J]
  double damping_at(double) const { return damping; }  // [N s/m]
  double damping_slope(double) const { return 0.0; }   // by e [N s/m2]

 private:
  double blend() const;  // w [m]
};

}  // namespace clatter::dynamics
