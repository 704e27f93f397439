// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/component_keys.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/given/speed_table.hpp"

namespace clatter::dynamics {

void read_body(const Config& table, const std::string& name, BodySpec& body) {
  body.name = name;
  body.rom = table.path("rom");
  body.elastic = table.choice("model", {"elastic", "rigid"}) == "elastic";
  body.mode_limit_hz = table.number_or("mode_limit_hz", 0.0, Range::between(0.0, 1e9));
  read_error_scales(table, body);
  body.where = table.where();
}

CrankClock read_crank_clock(const Config& engine) {
  const Range speeds = Range::between(0.01, 1e5);
  constexpr double kRpm = std::numbers::pi / 30.0;
  if (engine.has("speed_table")) {
    for (const char* key : {"speed_rpm", "order"})
      if (engine.has(key)) engine.fail(key, "found with speed_table, expected one of both");
    CrankClock clock =
        read_speed_table(engine.path("speed_table"), engine.text_or("speed_column", ""));
    if (!(clock.speed >= speeds.min * kRpm && clock.speed <= speeds.max * kRpm))
      engine.fail("speed_table", fmt::format("found a mean of {:g} rpm, expected {:g} to {:g}",
                                             clock.speed / kRpm, speeds.min, speeds.max));
    return clock;
  }
  CrankClock clock{engine.number("speed_rpm", speeds) * kRpm};
  for (const Config& one : engine.tables("order")) {
    SpeedOrder order;
    order.order = one.number("order", Range::between(0.5, 1000.0));
    if (std::remainder(order.order, 0.5) != 0.0)
      one.fail("order", fmt::format("found {:g}, expected a multiple of 0.5, which repeats in each "
                                    "cycle",
                                    order.order));
    order.amplitude = one.number("amplitude_rpm", speeds) * kRpm;
    order.phase = one.number_or("phase_deg", 0.0, Range::between(-1e6, 1e6)) * kDegree;
    clock.orders.push_back(order);
  }
  if (!clock.is_forward())
    engine.fail("order", fmt::format("found amplitudes of {:g} rpm and more, expected less in all "
                                     "than speed_rpm: the crank always turns",
                                     clock.speed / kRpm));
  return clock;
}

Spline::Kind read_interpolation(const Config& table, std::string_view fallback) {
  const bool linear_first = fallback == "linear";
  const std::string kind = linear_first ? table.choice("interpolation", {"linear", "cubic"})
                                        : table.choice("interpolation", {"cubic", "linear"});
  return kind == "linear" ? Spline::Kind::kLinear : Spline::Kind::kMonotoneCubic;
}

std::string read_name(const Config& table) {
  const std::string name = table.text("name");
  if (name.empty() || name == "." || name.find('/') != std::string::npos)
    table.fail("name", fmt::format("found \"{}\", expected a name without /", name));
  return name;
}

Eigen::Vector4d read_quaternion(const Config& table) {
  const std::vector<double> q = table.numbers_or("quaternion", {1.0, 0.0, 0.0, 0.0});
  if (q.size() != 4)
    table.fail("quaternion", fmt::format("found {} numbers, expected 4: w, x, y, z", q.size()));
  const Eigen::Vector4d found(q[0], q[1], q[2], q[3]);
  if (!(std::abs(found.norm() - 1.0) < 1e-3))
    table.fail("quaternion", fmt::format("found length {:g}, expected 1", found.norm()));
  return found;
}

Eigen::Vector3d read_vector(const Config& table, std::string_view key, double limit) {
  const std::vector<double> values = table.numbers(key, 3);
  for (const double value : values)
    if (!(std::abs(value) <= limit))
      table.fail(key, fmt::format("found {:g}, expected at least {:g} and at most {:g}", value,
                                  -limit, limit));
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d read_direction(const Config& table, std::string_view key) {
  const Eigen::Vector3d direction = read_vector(table, key, 1e6);
  if (!(direction.norm() >= 1e-6))
    table.fail(key, "found a vector without length, expected a direction");
  return direction.normalized();
}

PointSpec read_point(const Config& table, std::string_view key) {
  const Config at = table.table(key);
  PointSpec point;
  point.where = table.where(key);
  point.body = at.text_or("body", "");
  if (at.has("set")) point.set = at.text("set");
  if (at.has("at_mm")) point.at = read_vector(at, "at_mm", 1e6) * kMilli;
  if (point.at && !point.set.empty())
    at.fail("at_mm", "found a position and a set, expected one of both");
  return point;
}

}  // namespace clatter::dynamics
