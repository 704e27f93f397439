// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/plausible.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "core/base/log.hpp"

namespace clatter {
namespace {

/// A unit that may have been meant, and its value in SI.
struct Unit {
  const char* name;
  double si;
};

struct Bounds {
  double low, high;
  bool hold(double value) const { return value >= low && value <= high; }
};

// "did you mean 7850 (7.85e-09 t/mm3)?" for the first unit that brings the number into `usual`.
std::string guess(double value, Bounds usual, std::span<const Unit> units) {
  for (const Unit& unit : units)
    if (usual.hold(value * unit.si))
      return std::string_view(unit.name).find("not") != std::string_view::npos
                 ? fmt::format(": did you mean {:.6g} ({})?", value * unit.si, unit.name)
                 : fmt::format(": did you mean {:.6g} ({:.6g} {})?", value * unit.si, value,
                               unit.name);
  return "";
}

}  // namespace

std::string density_warning(double density) {
  constexpr Bounds kPossible = {10.0, 23000.0}, kUsual = {500.0, 23000.0};
  constexpr Unit kUnits[] = {{"t/mm3", 1e12}, {"kg/mm3", 1e9},   {"lbf s2/in4", 1.0687e7},
                             {"g/cm3", 1e3},  {"lb/in3", 27680}, {"g/m3", 1e-3}};
  if (kPossible.hold(density)) return "";
  return fmt::format("density {:.6g} kg/m3{}", density, guess(density, kUsual, kUnits));
}

std::string modulus_warning(double modulus, double density) {
  constexpr Bounds kPossible = {3e5, 1.3e12}, kUsual = {5e9, 1.3e12};
  constexpr Unit kUnits[] = {{"GPa", 1e9},         {"MPa", 1e6},          {"psi", 6894.757},
                             {"kPa", 1e3},         {"Pa, not MPa", 1e-6}, {"MPa, not GPa", 1e-3},
                             {"Pa, not GPa", 1e-9}};
  constexpr double kMetal = 2500.0, kSlowest = 500.0;
  const bool too_slow =
      density > kMetal && density <= 23000.0 && std::sqrt(modulus / density) < kSlowest;
  if (kPossible.hold(modulus) && !too_slow) return "";
  return fmt::format(
      "Young's modulus {:.6g} Pa{}{}", modulus,
      kPossible.hold(modulus) ? fmt::format(" with density {:.6g} kg/m3", density) : "",
      guess(modulus, kUsual, kUnits));
}

std::string poisson_warning(double poisson) {
  return poisson < 0.0 ? fmt::format("Poisson's ratio {:.6g}", poisson) : "";
}

std::string length_warning(double length) {
  constexpr Bounds kPossible = {1e-3, 30.0}, kUsual = {5e-3, 15.0};
  constexpr Unit kUnits[] = {
      {"mm", 1e-3}, {"um", 1e-6}, {"m, not mm", 1e3}, {"in, not mm", 25.4}, {"m, not um", 1e6}};
  if (kPossible.hold(length)) return "";
  return fmt::format("the part is {:.4g} m long{}", length, guess(length, kUsual, kUnits));
}

std::string first_frequency_warning(double hz, double length) {
  constexpr Bounds kPossible = {0.02, 2e4};
  if (kPossible.hold(hz * length)) return "";
  return fmt::format(
      "first elastic frequency {:.4g} Hz of a part of {:.4g} m: are E, rho and lengths in one "
      "system of units (Pa, kg/m3, m)?",
      hz, length);
}

void warn_implausible(const std::string& where, const std::vector<std::string>& warnings) {
  std::vector<std::string> distinct;
  for (const std::string& warning : warnings)
    if (!warning.empty() && std::find(distinct.begin(), distinct.end(), warning) == distinct.end())
      distinct.push_back(warning);
  if (!distinct.empty()) warn(fmt::format("{}: {}", where, fmt::join(distinct, "; ")));
}

}  // namespace clatter
