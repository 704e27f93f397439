// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/speed_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/csv_table.hpp"
#include "dynamics/given/load_table.hpp"
#include "dynamics/given/turn_table.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kTurns = 4.0 * std::numbers::pi;
constexpr double kShort = 1e-3;  // of a cycle, by which a table may end before 720 deg
constexpr int kClockPoints = 1440;

[[noreturn]] void reject(const std::filesystem::path& path, int line, const std::string& said) {
  throw InputError(fmt::format("{}:{}: {}", path.string(), line, said));
}

/// The clock whose crank is at `angle[i]` at `time[i]`, of a cycle that ends at `cycle`.
CrankClock clock_through(const std::vector<double>& time, std::vector<double> angle, double cycle) {
  CrankClock clock{kTurns / cycle};
  for (size_t i = 0; i < time.size(); ++i) angle[i] -= clock.speed * time[i];
  clock.deviation = std::make_shared<const PeriodicSpline>(3, time, angle, cycle);
  return clock;
}

/// Over the angle: the time is the integral of 1 / speed, by Gauss' rule of three points.
CrankClock clock_over_angle(const Spline& speed) {
  const double step = kTurns / kClockPoints, off = std::sqrt(0.6);
  std::vector<double> time, angle;
  double now = 0.0;
  for (int i = 0; i < kClockPoints; ++i) {
    angle.push_back(i * step);
    time.push_back(now);
    const double middle = (i + 0.5) * step;
    now += step / 18.0 *
           (5.0 / speed(middle - 0.5 * off * step) + 8.0 / speed(middle) +
            5.0 / speed(middle + 0.5 * off * step));
  }
  return clock_through(time, std::move(angle), now);
}

/// When the table's crank, at 0 at the begin, has turned by one cycle [s].
double cycle_of(const CsvColumns& table, const TurnTable& turn, const std::filesystem::path& path) {
  double low = table.x.front(), high = table.x.back();
  const double whole = turn.at(high).position;
  if (whole < kTurns * (1.0 - kShort))
    reject(path, table.lines.back(),
           fmt::format("the table turns the crank by {:.6g} deg, expected at least 720 deg",
                       whole / kDegree));
  if (whole < kTurns) {
    low = high;
    high += 2.0 * (kTurns - whole) / turn.at(high).velocity;
  }
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (turn.at(middle).position < kTurns ? low : high) = middle;
  }
  const double first = turn.at(table.x.front()).velocity, last = turn.at(high).velocity;
  if (std::abs(last - first) > 0.01 * first)
    reject(path, table.lines.back(),
           fmt::format("after 720 deg the speed is {:.6g} rad/s, expected that of the first row, "
                       "{:.6g}, within 1 %",
                       last, first));
  return high - table.x.front();
}

CrankClock clock_over_time(const CsvColumns& table, const std::filesystem::path& path) {
  if (table.x.size() < 4)
    reject(path, table.lines.back(),
           fmt::format("found {} rows, expected a complete cycle", table.x.size()));
  const TurnTable turn = TurnTable::of_speed(table.x, table.y);
  const double cycle = cycle_of(table, turn, path);
  std::vector<double> time, angle;
  for (int i = 0; i < kClockPoints; ++i) {
    time.push_back(cycle * i / kClockPoints);
    angle.push_back(turn.at(table.x.front() + time.back()).position);
  }
  return clock_through(time, std::move(angle), cycle);
}

}  // namespace

CrankClock read_speed_table(const std::filesystem::path& path, const std::string& column) {
  const CsvColumns table = read_csv(path, column);
  if (table.unit != "rad/s")
    reject(path, table.lines.front() - 1,
           fmt::format("{}: found [{}], expected a speed in [rpm] or [rad/s]", table.name,
                       table.unit));
  for (size_t i = 0; i < table.y.size(); ++i)
    if (!(table.y[i] > 0.0))
      reject(path, table.lines[i],
             fmt::format("{}: found {:g} rad/s, expected above 0: the crank always turns",
                         table.name, table.y[i]));
  if (table.abscissa_unit == "s") return clock_over_time(table, path);
  return clock_over_angle(read_cycle_table(path, column, "rad/s", Spline::Kind::kMonotoneCubic));
}

}  // namespace clatter::dynamics
