// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Compressible content of a hydraulic chamber: oil with free air, or air alone.

namespace clatter::dynamics {

/// Pressure at which density and free air are given [Pa].
inline constexpr double kReferencePressure = 1e5;

/// Oil with free air.
struct OilSpec {
  double density = 850.0;    // at 1 bar [kg/m3]
  double modulus = 1.4e9;    // of oil without air [Pa]
  double free_air = 0.03;    // volume of air over that of oil, at 1 bar
  double polytropic = 1.4;   // exponent of the air
  double viscosity = 10e-3;  // dynamic [Pa s]
};

/// Air at 20 degC in place of oil, as in a chamber that ran dry. `polytropic` as of the oil's.
OilSpec dry_air(double polytropic);

/// Density as a function of pressure, which is positive for every density: a chamber whose volume
/// grows faster than oil comes in gets a low pressure by this law alone.
///
/// Oil with the share a of air, with p0 = 1 bar (a form of the effective modulus in wide use, see
/// Gholizadeh, Burton and Schoenau 2011):
///
///   E = E0 (1 + a) / (1 + a p0^(1/k) E0/k p^-(1 + 1/k))  =  rho dp/d rho
///   (1 + a) ln(rho / rho0) = (p - p0) / E0 - a ((p0/p)^(1/k) - 1)
///
/// It takes the total volume as that at p0: at 3.5 bar and 3 % it is 1.7 % above the modulus of the
/// exact sum of volumes, and below p0 (a / (1 + a))^k, 0.7 kPa, softer than air. Air: E = k p.
class ChamberFluid {
 public:
  /// All values of the oil are positive, its polytropic exponent is above 1.
  static ChamberFluid oil(const OilSpec& oil);
  static ChamberFluid air(const OilSpec& air);

  /// At absolute pressure p > 0 [Pa].
  double modulus(double pressure) const;  // [Pa]
  double density(double pressure) const;  // [kg/m3]
  /// Integral of dp / rho from 1 bar [J/kg]: what a unit mass gains when it is pushed to
  /// `pressure`.
  double enthalpy(double pressure) const;
  /// The inverse of density(), to rounding; for density > 0.
  double pressure(double density) const;

 private:
  ChamberFluid(const OilSpec& spec, bool is_air) : spec_(spec), is_air_(is_air) {}
  double log_density(double pressure) const;  // ln(rho / rho0)
  double oil_pressure(double log_density) const;
  OilSpec spec_;
  bool is_air_;
};

}  // namespace clatter::dynamics
