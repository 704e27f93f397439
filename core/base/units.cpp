// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter {

double rounded(double value, int digits) {
  if (!std::isfinite(value)) return value;
  const std::string text = fmt::format("{:.{}g}", value, digits);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}
namespace {

constexpr double kInch = 25.4e-3;                // [m]
constexpr double kPoundForce = 4.4482216152605;  // [N]
constexpr double kSlinch = kPoundForce / kInch;  // lbf s2 / in [kg]

const std::array<UnitSystem, 6> kKnown = {{
    {"m-kg-s", 1.0, 1.0, 1.0},
    {"mm-t-s", 1e-3, 1e3, 1.0},
    {"mm-kg-ms", 1e-3, 1.0, 1e-3},
    {"mm-kg-s", 1e-3, 1.0, 1.0},
    {"cm-g-s", 1e-2, 1e-3, 1.0},
    {"in-lbfs2/in-s", kInch, kSlinch, 1.0},
}};

}  // namespace

std::vector<std::string> unit_system_names() {
  std::vector<std::string> names;
  for (const UnitSystem& units : kKnown) names.push_back(units.name);
  return names;
}

UnitSystem unit_system_named(std::string_view name, const std::string& where) {
  for (const UnitSystem& units : kKnown)
    if (units.name == name) return units;
  throw InputError(fmt::format("{}: found units '{}', expected one of: {}", where, name,
                               fmt::join(unit_system_names(), ", ")));
}

}  // namespace clatter
