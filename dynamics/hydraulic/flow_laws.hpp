// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Volume flows through gaps and openings.

namespace clatter::dynamics {

/// A volume flow [m3/s] with its derivatives by the pressure difference and by a ball's lift.
struct VolumeFlow {
  double value = 0.0, by_pressure = 0.0, by_lift = 0.0;
};

/// The annular gap between plunger and housing.
struct LeakGap {
  double height = 80e-6;      // radial [m]; 0: sealed
  double length = 11e-3;      // [m]
  double eccentricity = 0.0;  // of the plunger over the gap's height, 0 to 1
  bool to_supply = false;     // its far side is at the supply's pressure, else outside
};

/// Laminar flow over pressure difference G = pi d h^3 (1 + 1.5 e^2) / (12 mu L) [m3/(s Pa)] of an
/// annular gap of diameter d (Merritt 1967); viscosity mu [Pa s].
double leak_conductance(const LeakGap& gap, double diameter, double viscosity);

/// Flow of an orifice, sqrt(2/rho) area dp / (dp^2 + laminar^2)^(1/4): turbulent, laminar near
/// dp = 0 so that it is smooth; 2.5e-7 below the turbulent one at dp = 1000 laminar.
/// @param area effective, discharge coefficient included [m2]. @param laminar [Pa].
VolumeFlow orifice_flow(double area, double density, double laminar, double pressure);

/// A valve that opens at a pressure difference.
struct ReliefSpec {
  double opening = 0.0;   // [Pa]; 0: there is none
  double gradient = 0.0;  // flow over pressure above it [m3/(s Pa)]
};

/// Zero up to the opening pressure, then gradient (dp - opening); joined by a parabola over 5 % of
/// the opening pressure.
VolumeFlow relief_flow(const ReliefSpec& relief, double pressure);

/// 3 u^2 - 2 u^3 between 0 and 1, constant outside, and its slope.
struct SmoothStep {
  double value, slope;
};
SmoothStep smooth_step(double u);

}  // namespace clatter::dynamics
