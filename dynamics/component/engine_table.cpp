// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/engine_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dynamics/component/component_keys.hpp"
#include "dynamics/given/speed_table.hpp"

namespace clatter::dynamics {
namespace {

const Range kCrankSpeedRpm = Range::between(0.01, 1e5);
constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]

const Keys<SpeedOrder>& speed_order_keys() {
  static const Keys<SpeedOrder> keys(
      "order", "an order of the crank's speed", [](auto& key, SpeedOrder& order) {
        key.number("order", order.order, Range::between(0.5, 1000.0),
                   "per turn, a multiple of 0.5, which repeats in each cycle")
            .required();
        key.number("amplitude_rpm", order.amplitude, kCrankSpeedRpm, "amplitude of its cosine")
            .required();
        key.number("phase_deg", order.phase, kAngleDeg, "of its cosine over the mean angle");
        key.check([](const Config& table, SpeedOrder& found) {
          if (std::remainder(found.order, 0.5) != 0.0)
            table.fail("order", fmt::format("found {:g}, expected a multiple of 0.5, which repeats "
                                            "in each cycle",
                                            found.order));
        });
      });
  return keys;
}

void check_clock(const Config& table, EngineTable& engine) {
  CrankClock& clock = engine.clock;
  if (engine.speed_table.empty()) {
    if (!clock.is_forward())
      table.fail("order", fmt::format("found amplitudes of {:g} rpm and more, expected less in all "
                                      "than speed_rpm: the crank always turns",
                                      clock.speed / kRpm));
    return;
  }
  clock = read_speed_table(engine.speed_table, engine.speed_column);
  if (!(clock.speed >= kCrankSpeedRpm.min * kRpm && clock.speed <= kCrankSpeedRpm.max * kRpm))
    table.fail("speed_table",
               fmt::format("found a mean of {:g} rpm, expected {:g} to {:g}", clock.speed / kRpm,
                           kCrankSpeedRpm.min, kCrankSpeedRpm.max));
}

}  // namespace

const Keys<StrokeSpec>& stroke_keys() {
  static const Keys<StrokeSpec> keys(
      "engine", "stroke and pin of a cylinder", [](auto& key, StrokeSpec& stroke) {
        key.where(stroke.pin_offset_where, "pin_offset_mm");
        key.number("stroke_mm", stroke.stroke, Range::between(0.1, 1e4), "stroke of the piston")
            .required();
        key.number("pin_offset_mm", stroke.pin_offset, Range::between(-1e4, 1e4),
                   "of the pin from the bore's axis, toward the thrust side");
        key.flag("balanced", stroke.balanced,
                 "inertia forces of piston and rod do not move the block as a rigid body");
        key.choice("rotation", stroke.rotation,
                   {{"forward", Rotation::kForward}, {"backward", Rotation::kBackward}},
                   "forward is positive about x");
      });
  return keys;
}

const Keys<EngineTable>& engine_keys() {
  static const Keys<EngineTable> keys(
      "engine", "speed, stroke and pin of an engine", [](auto& key, EngineTable& engine) {
        key.number("speed_rpm", engine.clock.speed, kCrankSpeedRpm, "mean speed of the crank");
        key.tables("order", engine.clock.orders, speed_order_keys())
            .excludes("speed_table", "the table has the entire course of the speed");
        key.path("speed_table", engine.speed_table,
                 "CSV of the speed over one cycle of the crank angle, or over time");
        key.text("speed_column", engine.speed_column, "its column; without it the second one")
            .needs("speed_table");
        key.one_of({"speed_rpm", "speed_table"});
        key.check(check_clock);
        key.part(engine.stroke, stroke_keys());
      });
  return keys;
}

}  // namespace clatter::dynamics
