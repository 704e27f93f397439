// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/crank_keys.hpp"

#include <fmt/format.h>

#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

void check_crank(const Config& table, CrankBody& crank) {
  crank.in_bearings = table.has("bearing");
  if (!crank.in_bearings && !crank.is_free)
    table.fail("bearing",
               "give [[crank.bearing]] or speed = \"free\": a crank without both needs no [crank]");
  if (crank.in_bearings && crank.diametral < 0.5 * crank.polar)
    table.fail("diametral_kg_m2", fmt::format("found {:g}, expected at least {:g}, half of "
                                              "polar_kg_m2, as that of a thin disc",
                                              crank.diametral, 0.5 * crank.polar));
}

}  // namespace

const Keys<CrankBody>& crank_body_keys() {
  static const Keys<CrankBody> keys("crank", "the crankshaft", [](auto& key, CrankBody& crank) {
    const Range moment = Range::between(1e-9, 1e9);
    key.shared();
    key.where(crank.where);
    key.choice("speed", crank.is_free, {{"prescribed", false}, {"free", true}},
               "that of [engine], or free under gas, inertia and load");
    key.number("polar_kg_m2", crank.polar, moment,
               "moment of inertia about the axis, with the flywheel")
        .required_with("speed", "free");
    key.number("mass_kg", crank.mass, Range::between(1e-6, 1e7), "mass, with the flywheel")
        .of("bearing");
    key.number("diametral_kg_m2", crank.diametral, moment,
               "moment of inertia across the axis, about the centre of mass: at least half of "
               "polar_kg_m2")
        .of("bearing");
    key.number("centre_mm", crank.centre, kPositionMm, "x of the centre of mass").of("bearing");
    key.check(check_crank);
  });
  return keys;
}

std::optional<CrankBody> read_crank_body(const Config& root) {
  const auto table = root.find_table("crank");
  if (!table) return std::nullopt;
  return crank_body_keys().read(*table);
}

}  // namespace clatter::dynamics
