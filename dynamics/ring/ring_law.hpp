// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Friction of a piston ring on its liner over the duty parameter.

namespace clatter::dynamics {

/// A ring of [[contact.ring]].
struct RingSpec {
  double height = 0.0;       // of its middle above the pin's centre [m]
  double face_radius = 0.0;  // R of its face along the stroke [m]
  double load = 0.0;         // W' of its own tension [N/m of circumference]
  double least = 0.0;        // least layer of oil that it leaves [m]
  double width = 0.0;        // along the stroke [m]
  double thickness = 0.0;    // radial, in its groove [m]
  double gas_share = 0.0;    // of the gas pressure behind it in the cylinder's
  double mass = 0.0;         // [kg]
  double boundary = 0.0;  // friction coefficient of the rubbing face; 0: no friction on the liner
  double roughness = 0.3e-6;  // rms of face and liner together [m]
  double groove = 0.0;  // friction coefficient of its sides; 0: the piston slides freely in it

  bool acts() const { return boundary > 0.0 || groove > 0.0; }
};

/// Friction coefficient and its slope by the duty parameter.
struct RingFriction {
  double value, slope;
};

/// Friction coefficient of a ring over the duty parameter S = mu |U| / W':
///
///   f = a f_b + (1 - a) c sqrt(S),   a = (1 - lambda / 4)^6.804 for lambda < 4, else 0
///   lambda = h_0 / sigma,   h_0 = 2.4475 S R
///
/// h_0 is the film of a parabolic face (Martin 1916), as for the layer that the ring leaves. Its
/// shear on the liner up to the rupture gives c = 3.2914 for every R: with x = sqrt(2 R h_0) tan g
/// and rupture at g_c = 0.44355, F' = mu U sqrt(2 R / h_0) [4 (g_c + pi/2) - 3 I / cos^2 g_c], I
/// the integral of cos^2 g. The share a of the asperities falls with the film as their pressure
/// does, eq. (12) of the paper over its value at 0.
/// @param duty S >= 0.
RingFriction ring_friction(const RingSpec& ring, double duty);

/// Force along the stroke on a unit length of the ring's face [N/m] that slides at U, and its slope
/// by U [N s/m2].
struct RingShear {
  double force, slope;
};
/// -W' f(S) U / r with r = sqrt(U^2 + u_0^2), which also takes the place of |U| in S.
/// @param viscosity mu [Pa s]. @param load W' > 0 [N/m]. @param speed U [m/s]. @param reversal u_0
/// [m/s].
RingShear ring_shear(const RingSpec& ring, double viscosity, double load, double speed,
                     double reversal);

}  // namespace clatter::dynamics
