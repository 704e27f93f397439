// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/recess_table.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace clatter::dynamics {
namespace {

void check_recess(const Config& table, RecessTable& found) {
  film::Recess& recess = found.recess;
  recess.bottom = found.height[0];
  recess.top = found.height[1];
  if (table.has("angle_deg")) {
    const double span = found.angle[1] - found.angle[0];
    if (span > 360.0)
      table.fail("angle_deg", fmt::format("found a span of {:g}, expected at most 360", span));
    recess.angle_begin = found.angle[0] * kDegree;
    recess.angle_span = span * kDegree;
  }
  if (recess.pressure > 0.0 && recess.fill < 1.0)
    table.fail("fill", fmt::format("found {:g} under pressure, expected 1", recess.fill));
}

}  // namespace

const keys::Keys<RecessTable>& recess_keys() {
  using Kind = film::Recess::Kind;
  static const keys::Keys<RecessTable> keys(
      "recess", "a groove or hole of skirt or liner, or a window of the skirt",
      [](auto& key, RecessTable& table) {
        key.choice("kind", table.recess.kind,
                   {{"groove", Kind::kGroove}, {"window", Kind::kWindow}},
                   "connected to a reservoir, or cut away");
        key.vector("height_mm", table.height, Range::between(-1e4, 1e4),
                   "from and to, above the pin, on the liner above the crank axis")
            .ascending()
            .required();
        key.vector("angle_deg", table.angle, Range::between(-360.0, 720.0),
                   "from and to, right-handed about the bore from the thrust side; all around "
                   "without it")
            .unconverted()
            .ascending();
        key.all_need(
            "kind", "groove",
            "a window is a part of the skirt that is cut away, at the pressure of the crankcase",
            [&] {
              key.choice("on", table.recess.on_liner, {{"skirt", false}, {"liner", true}},
                         "where the groove is");
              key.number("pressure_bar", table.recess.pressure, Range::between(0.0, 1e4),
                         "pressure of the oil in the groove over that of the crankcase");
              key.number("fill", table.recess.fill, Range::between(0.0, 1.0),
                         "part of the groove that is full of oil; 0 of a port in the liner");
            });
        key.check(check_recess);
      });
  return keys;
}

}  // namespace clatter::dynamics
