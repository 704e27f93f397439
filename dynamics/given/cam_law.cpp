// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/cam_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/csv_table.hpp"
#include "dynamics/given/overshoot.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSame = 1e-9;

[[noreturn]] void refuse(const std::filesystem::path& path, int line, const std::string& message) {
  throw InputError(fmt::format("{}:{}: {}", path.string(), line, message));
}

/// Columns over one period, without a closing row.
CsvColumns period_columns(const std::filesystem::path& path, const std::string& column,
                          const std::string& unit, double period) {
  CsvColumns table = read_csv(path, column);
  const int header = table.lines.front() - 1, last = table.lines.back();
  if (table.abscissa_unit != "rad")
    refuse(path, header,
           fmt::format("{} is in [{}], expected [deg] or [rad]", table.abscissa_name,
                       table.abscissa_unit));
  if (table.unit != unit)
    refuse(path, header,
           fmt::format("{} is in [{}], expected a unit of [{}]", table.name, table.unit, unit));
  const double span = table.x.back() - table.x.front();
  if (span > period * (1.0 + kSame))
    refuse(path, last,
           fmt::format("the table spans {:.6g} deg, expected one period of {:.6g} deg",
                       span / kDegree, period / kDegree));
  if (span > period * (1.0 - kSame)) {
    const auto [low, high] = std::minmax_element(table.y.begin(), table.y.end());
    if (std::abs(table.y.back() - table.y.front()) > 1e-3 * (*high - *low))
      refuse(path, last,
             fmt::format("the last row closes the period with {:.6g} {}, expected the first row's "
                         "{:.6g}",
                         table.y.back(), table.unit, table.y.front()));
    table.x.pop_back();
    table.y.pop_back();
    table.lines.pop_back();
  }
  if (table.x.size() < 4)
    refuse(path, last, fmt::format("found {} rows, expected a complete period", table.x.size()));
  double longest = 0.0;
  for (size_t i = 1; i < table.x.size(); ++i)
    longest = std::max(longest, table.x[i] - table.x[i - 1]);
  const double open = table.x.front() + period - table.x.back();
  if (open > 2.0 * longest)
    refuse(path, last,
           fmt::format("the table ends {:.6g} deg before the period of {:.6g} deg", open / kDegree,
                       period / kDegree));
  return table;
}

/// The periodic spline through a table. InputError when it swings beside a flank.
PeriodicSpline spline_through(CsvColumns table, const std::filesystem::path& path, double period,
                              int degree) {
  PeriodicSpline spline(degree, table.x, table.y, period);
  table.x.push_back(table.x.front() + period);
  table.y.push_back(table.y.front());
  const Overshoot found =
      find_overshoot([&](double at) { return spline.at(at).value; }, table.x, table.y);
  if (!found.is_wild()) return spline;
  refuse(path, table.lines[found.row],
         fmt::format("{}: the smooth curve leaves the rows by {:.3g} {} between {:.9g} and {:.9g} "
                     "deg, more than the largest step from row to row, {:.3g}, expected more rows "
                     "beside the steep flanks",
                     table.name, found.size, table.unit, table.x[found.row] / kDegree,
                     table.x[found.row + 1] / kDegree, found.step));
}

}  // namespace

CamLaw::CamLaw(std::variant<Polynomial, PeriodicSpline> law) : law_(std::move(law)) {}

CamLaw CamLaw::polynomial(double lift, double half_angle) {
  return CamLaw(Polynomial{lift, half_angle});
}

CamLaw CamLaw::table(PeriodicSpline spline) { return CamLaw(std::move(spline)); }

SplinePoint CamLaw::at(double angle) const {
  if (const auto* spline = std::get_if<PeriodicSpline>(&law_)) return spline->at(angle);
  const auto& [lift, half] = std::get<Polynomial>(law_);
  const double x = std::remainder(angle, kTurn) / half;
  if (std::abs(x) >= 1.0) return {};
  const double r = 1.0 - x * x;
  return {lift * r * r * r, -6.0 * lift / half * x * r * r,
          6.0 * lift / (half * half) * r * (4.0 * x * x - r),
          24.0 * lift / (half * half * half) * x * (3.0 * r - 2.0 * x * x)};
}

PeriodicSpline read_angle_table(const std::filesystem::path& path, const std::string& column,
                                const std::string& unit, double period, int degree) {
  return spline_through(period_columns(path, column, unit, period), path, period, degree);
}

CamLaw read_cam_table(const std::filesystem::path& path, const std::string& column, int degree) {
  CsvColumns table = period_columns(path, column, "m", kTurn);
  for (size_t i = 0; i < table.y.size(); ++i)
    if (table.y[i] < 0.0)
      refuse(path, table.lines[i],
             fmt::format("{}: found {:g} mm, expected a lift of at least 0", table.name,
                         table.y[i] / kMilli));
  return CamLaw::table(spline_through(std::move(table), path, kTurn, degree));
}

}  // namespace clatter::dynamics
