// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The degree; consistent unit systems: decks and matrix files name none, so the user specifies one.
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace clatter {

inline constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
inline constexpr double kMilli = 1e-3, kMicro = 1e-6;

/// The decimal number of so many significant digits next to a finite value, whatever the language
/// of the application (hard case P13): 0.00004 / 1e-6 to 15 digits is 40.
double rounded(double value, int digits);

/// A consistent system: forces are mass * length / time^2.
struct UnitSystem {
  std::string name = "m-kg-s";
  double length = 1.0;  // [m] per unit
  double mass = 1.0;    // [kg]
  double time = 1.0;    // [s]

  double force() const { return mass * length / (time * time); }
  double pressure() const { return mass / (length * time * time); }
};

/// "m-kg-s" (N, Pa), "mm-t-s" (N, MPa), "mm-kg-ms" (kN, GPa), "mm-kg-s" (mN, kPa), "cm-g-s" or
/// "in-lbfs2/in-s" (lbf, psi). InputError, prefixed with `where`, lists them for an unknown name.
UnitSystem unit_system_named(std::string_view name, const std::string& where);
/// The names that it knows.
std::vector<std::string> unit_system_names();

}  // namespace clatter
