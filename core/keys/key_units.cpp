// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/key_units.hpp"

#include <numbers>

#include "core/base/units.hpp"

namespace clatter::keys {
namespace {

struct Suffix {
  std::string_view name;
  KeyUnit unit;
};

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
constexpr double kZeroCelsius = 273.15;           // [K]

const Suffix kSuffixes[] = {
    {"mm", {"mm", kMilli}},
    {"um", {"um", kMicro}},
    {"m", {"m"}},
    {"mm2", {"mm2", 1e-6}},
    {"cm3", {"cm3", 1e-6}},
    {"m3", {"m3"}},
    {"1_mm2", {"1/mm2", 1e6}},
    {"deg", {"deg", kDegree}},
    {"rad", {"rad"}},
    {"s", {"s"}},
    {"ms", {"ms", kMilli}},
    {"us", {"us", kMicro}},
    {"hz", {"Hz"}},
    {"rpm", {"rpm", kRpm}},
    {"rad_s", {"rad/s"}},
    {"1_s", {"1/s"}},
    {"m_s", {"m/s"}},
    {"um_s", {"um/s", kMicro}},
    {"m_s2", {"m/s2"}},
    {"mm2_s", {"mm2/s", 1e-6}},
    {"ml_s_bar", {"ml/(s bar)", 1e-11}},
    {"kg", {"kg"}},
    {"g", {"g", kMilli}},
    {"g_mm", {"g mm", 1e-6}},
    {"kg_m", {"kg m"}},
    {"kg_m2", {"kg m2"}},
    {"kg_m3", {"kg/m3"}},
    {"n", {"N"}},
    {"n_m", {"N/m"}},
    {"n_mm", {"N/mm", 1e3}},
    {"n_m3", {"N/m3"}},
    {"n_s_m", {"N s/m"}},
    {"n_m_rad", {"N m/rad"}},
    {"n_m_s", {"N m s"}},
    {"n_m_s_rad", {"N m s/rad"}},
    {"s_m", {"s/m"}},
    {"pa", {"Pa"}},
    {"pa_s", {"Pa s"}},
    {"mpa_s", {"mPa s", kMilli}},
    {"bar", {"bar", 1e5}},
    {"mpa", {"MPa", 1e6}},
    {"gpa", {"GPa", 1e9}},
    {"1_gpa", {"1/GPa", 1e-9}},
    {"c", {"deg C", 1.0, kZeroCelsius}},
    {"k", {"K"}},
    {"w", {"W"}},
};

bool ends_in(std::string_view name, std::string_view suffix) {
  if (name.size() <= suffix.size()) return false;
  const size_t at = name.size() - suffix.size();
  return name[at - 1] == '_' && name.substr(at) == suffix;
}

}  // namespace

KeyUnit unit_of(std::string_view name) {
  const Suffix* longest = nullptr;
  for (const Suffix& suffix : kSuffixes)
    if (ends_in(name, suffix.name) &&
        (longest == nullptr || suffix.name.size() > longest->name.size()))
      longest = &suffix;
  return longest == nullptr ? KeyUnit{} : longest->unit;
}

}  // namespace clatter::keys
