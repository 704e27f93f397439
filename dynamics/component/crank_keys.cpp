// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/crank_keys.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace clatter::dynamics {

std::optional<CrankBody> read_crank_body(const Config& root) {
  const auto table = root.find_table("crank");
  if (!table) return std::nullopt;
  const Range moment = Range::between(1e-9, 1e9);
  CrankBody crank;
  crank.where = table->where();
  crank.in_bearings = table->has("bearing");
  crank.is_free = table->choice("speed", {"prescribed", "free"}) == "free";
  if (!crank.in_bearings && !crank.is_free)
    table->fail("bearing",
                "found none, and the speed is prescribed, expected [[crank.bearing]], or speed = "
                "\"free\": a crank without both needs no [crank]");
  if (crank.is_free || table->has("polar_kg_m2"))
    crank.polar = table->number("polar_kg_m2", moment);
  if (!crank.in_bearings) return crank;
  crank.mass = table->number("mass_kg", Range::between(1e-6, 1e7));
  crank.diametral = table->number("diametral_kg_m2", moment);
  if (crank.diametral < 0.5 * crank.polar)
    table->fail("diametral_kg_m2", fmt::format("found {:g}, expected at least {:g}, half of "
                                               "polar_kg_m2, as that of a thin disc",
                                               crank.diametral, 0.5 * crank.polar));
  crank.centre = table->number("centre_mm", Range::between(-1e6, 1e6)) * kMilli;
  return crank;
}

}  // namespace clatter::dynamics
