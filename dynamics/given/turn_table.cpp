// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/turn_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/csv_table.hpp"
#include "dynamics/given/overshoot.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {
namespace {

/// Second derivatives of the natural cubic spline: a tridiagonal system (de Boor 1978).
std::vector<double> second_derivatives(const std::vector<double>& x, const std::vector<double>& y) {
  const size_t n = x.size();
  std::vector<double> second(n, 0.0), upper(n, 0.0);
  for (size_t i = 1; i + 1 < n; ++i) {
    const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
    const double pivot = 2.0 * (left + right) - left * upper[i - 1];
    upper[i] = right / pivot;
    const double bend = 6.0 * ((y[i + 1] - y[i]) / right - (y[i] - y[i - 1]) / left);
    second[i] = (bend - left * second[i - 1]) / pivot;
  }
  for (size_t i = n - 2; i > 0; --i) second[i] -= upper[i] * second[i + 1];
  return second;
}

/// Steps of more than half a turn against the direction of most: there an angle begins anew.
std::vector<size_t> wraps(const std::vector<double>& angle, double typical) {
  std::vector<size_t> rows;
  for (size_t i = 1; i < angle.size(); ++i) {
    const double step = angle[i] - angle[i - 1];
    if (std::abs(step) > std::numbers::pi && step * typical < 0.0) rows.push_back(i);
  }
  return rows;
}

/// The median of the steps from row to row.
double typical_step(const std::vector<double>& angle) {
  std::vector<double> steps;
  for (size_t i = 1; i < angle.size(); ++i) steps.push_back(angle[i] - angle[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Lets angles go on in whole turns at their wraps.
void unwrap_angles(std::vector<double>& angle, const std::vector<size_t>& wraps, double typical) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  double added = 0.0;
  const std::vector<double> given = angle;
  auto wrap = wraps.begin();
  for (size_t i = 1; i < angle.size(); ++i) {
    if (wrap != wraps.end() && *wrap == i) {
      added += kTurn * std::round((typical - (given[i] - given[i - 1])) / kTurn);
      ++wrap;
    }
    angle[i] += added;
  }
}

}  // namespace

TurnTable TurnTable::of_speed(std::vector<double> time, const std::vector<double>& speed) {
  const std::vector<double> slope = monotone_slopes(time, speed);
  TurnTable table(std::move(time));
  double angle = 0.0;
  for (size_t i = 0; i + 1 < speed.size(); ++i) {
    const double h = table.time_[i + 1] - table.time_[i], secant = (speed[i + 1] - speed[i]) / h;
    const double c2 = (3.0 * secant - 2.0 * slope[i] - slope[i + 1]) / h;
    const double c3 = (slope[i] + slope[i + 1] - 2.0 * secant) / (h * h);
    table.piece_.push_back({angle, speed[i], slope[i] / 2.0, c2 / 3.0, c3 / 4.0});
    angle += h * (speed[i] + h * (slope[i] / 2.0 + h * (c2 / 3.0 + h * c3 / 4.0)));
  }
  return table;
}

TurnTable TurnTable::of_angle(std::vector<double> time, const std::vector<double>& angle) {
  const std::vector<double> second = second_derivatives(time, angle);
  TurnTable table(std::move(time));
  for (size_t i = 0; i + 1 < angle.size(); ++i) {
    const double h = table.time_[i + 1] - table.time_[i];
    const double speed =
        (angle[i + 1] - angle[i]) / h - h * (2.0 * second[i] + second[i + 1]) / 6.0;
    table.piece_.push_back(
        {angle[i], speed, second[i] / 2.0, (second[i + 1] - second[i]) / (6.0 * h), 0.0});
  }
  return table;
}

Motion<double> TurnTable::at(double time) const {
  const double inside = std::clamp(time, time_.front(), time_.back());
  const auto right = std::upper_bound(time_.begin() + 1, time_.end() - 1, inside);
  const auto i = static_cast<size_t>(right - time_.begin()) - 1;
  const auto& c = piece_[i];
  const double t = inside - time_[i];
  Motion<double> motion{
      c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4]))),
      c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * 4.0 * c[4])),
      2.0 * c[2] + t * (6.0 * c[3] + t * 12.0 * c[4]),
  };
  if (time != inside) {
    motion.position += (time - inside) * motion.velocity;
    motion.acceleration = 0.0;
  }
  return motion;
}

TurnTable read_turn_table(const std::filesystem::path& path, const std::string& column, bool unwrap,
                          double begin, double end) {
  CsvColumns table = read_csv(path, column);
  const auto fail = [&](int line, const std::string& said) {
    throw InputError(fmt::format("{}:{}: {}", path.string(), line, said));
  };
  if (table.abscissa_unit != "s")
    fail(table.lines.front() - 1, fmt::format("{}: found [{}], expected a time, as [s]",
                                              table.abscissa_name, table.abscissa_unit));
  if (table.unit != "rad/s" && table.unit != "rad")
    fail(table.lines.front() - 1,
         fmt::format("{}: found [{}], expected a speed in [rpm] or [rad/s], or an angle in [deg] "
                     "or [rad]",
                     table.name, table.unit));
  if (table.x.size() < 2) fail(table.lines.back(), "found one row, expected at least two");
  require_covered(table, path, begin, end);
  if (table.unit == "rad/s") return TurnTable::of_speed(std::move(table.x), table.y);
  const double typical = typical_step(table.y);
  const std::vector<size_t> anew = wraps(table.y, typical);
  if (!anew.empty() && !unwrap)
    fail(table.lines[anew.front()],
         fmt::format(
             "{}: found {:g} deg after {:g} deg while other rows go the other way: an angle "
             "that begins anew throws the shaft back; with unwrap = true it goes on",
             table.name, table.y[anew.front()] / kDegree, table.y[anew.front() - 1] / kDegree));
  unwrap_angles(table.y, anew, typical);
  TurnTable turn = TurnTable::of_angle(table.x, table.y);
  const Overshoot found =
      find_overshoot([&](double at) { return turn.at(at).position; }, table.x, table.y);
  if (found.is_wild())
    fail(table.lines[found.row],
         fmt::format("{}: the smooth curve leaves the rows by {:.3g} deg between {:.9g} and {:.9g} "
                     "s, more than the largest step from row to row, {:.3g} deg, expected more "
                     "rows beside the steep flanks, or a table of the speed",
                     table.name, found.size / kDegree, table.x[found.row], table.x[found.row + 1],
                     found.step / kDegree));
  return turn;
}

}  // namespace clatter::dynamics
