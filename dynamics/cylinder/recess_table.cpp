// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/recess_table.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace clatter::dynamics {
namespace {

/// Two ascending numbers.
std::pair<double, double> read_pair(const Config& entry, const char* key, Range range) {
  const std::vector<double> found = entry.numbers(key, 2);
  for (const double one : found)
    if (!(one >= range.min && one <= range.max))
      entry.fail(key, fmt::format("found {:g}, expected {:g} to {:g}", one, range.min, range.max));
  if (!(found[1] > found[0]))
    entry.fail(key, fmt::format("found {:g} after {:g}, expected more", found[1], found[0]));
  return {found[0], found[1]};
}

film::Recess read_recess(const Config& entry) {
  film::Recess recess;
  const bool window = entry.choice("kind", {"groove", "window"}) == "window";
  recess.kind = window ? film::Recess::Kind::kWindow : film::Recess::Kind::kGroove;
  const auto [bottom, top] = read_pair(entry, "height_mm", Range::between(-1e4, 1e4));
  recess.bottom = bottom * kMilli;
  recess.top = top * kMilli;
  if (entry.has("angle_deg")) {
    const auto [begin, end] = read_pair(entry, "angle_deg", Range::between(-360.0, 720.0));
    if (end - begin > 360.0)
      entry.fail("angle_deg",
                 fmt::format("found a span of {:g}, expected at most 360", end - begin));
    recess.angle_begin = begin * kDegree;
    recess.angle_span = (end - begin) * kDegree;
  }
  for (const char* key : {"on", "pressure_bar", "fill"})
    if (window && entry.has(key))
      entry.fail(key,
                 "found in a window, expected only in a groove: a window is a part of the "
                 "skirt that is cut away, at the pressure of the crankcase");
  if (window) return recess;
  recess.on_liner = entry.choice("on", {"skirt", "liner"}) == "liner";
  recess.pressure = entry.number_or("pressure_bar", 0.0, Range::between(0.0, 1e4)) * 1e5;
  recess.fill = entry.number_or("fill", recess.fill, Range::between(0.0, 1.0));
  if (recess.pressure > 0.0 && recess.fill < 1.0)
    entry.fail("fill", fmt::format("found {:g} under pressure, expected 1", recess.fill));
  return recess;
}

}  // namespace

std::vector<film::Recess> read_recesses(const Config& contact) {
  std::vector<film::Recess> recesses;
  for (const Config& entry : contact.tables("recess")) recesses.push_back(read_recess(entry));
  return recesses;
}

}  // namespace clatter::dynamics
