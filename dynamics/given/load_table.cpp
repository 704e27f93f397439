// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/load_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/csv_table.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kCycle = 4.0 * std::numbers::pi;
constexpr double kGapFactor = 20.0;
constexpr double kLargestPressure = 1e9;  // of a gas; engines stay below 0.05 GPa [Pa]

void check_units(const CsvColumns& table, const std::filesystem::path& path,
                 const std::string& abscissa_unit, const std::string& unit) {
  const std::string where = fmt::format("{}:{}", path.string(), table.lines.front() - 1);
  if (table.abscissa_unit != abscissa_unit)
    throw InputError(fmt::format("{}: found {} in [{}] as the first column, expected {}", where,
                                 table.abscissa_name, table.abscissa_unit,
                                 abscissa_unit == "rad"
                                     ? "crank_angle [deg]: these values are over the crank angle"
                                     : "time [s]: these values are over time"));
  if (table.unit != unit)
    throw InputError(fmt::format("{}: {} is in [{}], expected a unit of [{}]", where, table.name,
                                 table.unit, unit));
}

double median_step(const CsvColumns& table) {
  std::vector<double> steps;
  for (size_t i = 1; i < table.x.size(); ++i) steps.push_back(table.x[i] - table.x[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

void refuse_gaps(const CsvColumns& table, const std::filesystem::path& path, double typical) {
  for (size_t i = 1; i < table.x.size(); ++i) {
    const double step = table.x[i] - table.x[i - 1];
    if (step > kGapFactor * typical) {
      throw InputError(
          fmt::format("{}:{}: a gap of {:.6g} deg from {:.6g} to {:.6g} deg, expected steps like "
                      "the median of {:.6g} deg",
                      path.string(), table.lines[i], step / kDegree, table.x[i - 1] / kDegree,
                      table.x[i] / kDegree, typical / kDegree));
    }
  }
}

/// Removes a closing row; rejects a table that is shorter or longer than one cycle.
void close_cycle(CsvColumns& table, const std::filesystem::path& path, double typical) {
  const double span = table.x.back() - table.x.front();
  const auto last_position = fmt::format("{}:{}", path.string(), table.lines.back());
  constexpr double kSame = 1e-9;
  if (span > kCycle * (1.0 + kSame)) {
    throw InputError(fmt::format("{}: the table spans {:.6g} deg, expected one cycle of 720 deg",
                                 last_position, span / kDegree));
  }
  if (span > kCycle * (1.0 - kSame)) {
    const auto [low, high] = std::minmax_element(table.y.begin(), table.y.end());
    if (std::abs(table.y.back() - table.y.front()) > 0.01 * (*high - *low)) {
      throw InputError(fmt::format(
          "{}: the last row closes the cycle with {:.6g} {}, expected the first row's {:.6g}",
          last_position, table.y.back(), table.unit, table.y.front()));
    }
    table.x.pop_back();
    table.y.pop_back();
    table.lines.pop_back();
    return;
  }
  if (kCycle - span > 2.0 * typical) {
    throw InputError(
        fmt::format("{}: the table ends {:.6g} deg before the cycle closes (from {:.6g} to {:.6g} "
                    "deg), expected 720 deg",
                    last_position, (kCycle - span) / kDegree, table.x.front() / kDegree,
                    table.x.back() / kDegree));
  }
}

/// One cycle without a closing row.
CsvColumns cycle_columns(const std::filesystem::path& path, const std::string& column,
                         const std::string& unit) {
  CsvColumns table = read_csv(path, column);
  check_units(table, path, "rad", unit);
  if (table.x.size() < 4) {
    throw InputError(fmt::format("{}:{}: found {} rows, expected a complete cycle", path.string(),
                                 table.lines.back(), table.x.size()));
  }
  const double typical = median_step(table);
  refuse_gaps(table, path, typical);
  close_cycle(table, path, typical);
  return table;
}

Spline cycle_spline(CsvColumns table, Spline::Kind kind) {
  return Spline(kind, std::move(table.x), std::move(table.y), kCycle);
}

}  // namespace

Spline read_cycle_table(const std::filesystem::path& path, const std::string& column,
                        const std::string& unit, Spline::Kind kind) {
  return cycle_spline(cycle_columns(path, column, unit), kind);
}

Spline read_gas_table(const std::filesystem::path& path, const std::string& column,
                      Spline::Kind kind) {
  CsvColumns table = cycle_columns(path, column, "Pa");
  for (size_t i = 0; i < table.y.size(); ++i) {
    if (table.y[i] >= 0.0 && table.y[i] <= kLargestPressure) continue;
    throw InputError(fmt::format(
        "{}:{}: {}: found {:g} bar, expected an absolute pressure from 0 to {:g} bar",
        path.string(), table.lines[i], table.name, 1e-5 * table.y[i], 1e-5 * kLargestPressure));
  }
  return cycle_spline(std::move(table), kind);
}

std::function<double(double)> rows_in_time(Spline table, std::function<double(double)> angle,
                                           std::function<double(double)> time) {
  return [table = std::move(table), angle = std::move(angle), time = std::move(time)](double now) {
    double row = table.next_point(angle(now));
    // The time of a row that the crank has just reached may round to one not after now.
    while (time(row) <= now) row = table.next_point(row);
    return time(row);
  };
}

Spline read_time_table(const std::filesystem::path& path, const std::string& column,
                       const std::string& unit, Spline::Kind kind, double begin, double end) {
  CsvColumns table = read_csv(path, column);
  check_units(table, path, "s", unit);
  require_covered(table, path, begin, end);
  return Spline(kind, std::move(table.x), std::move(table.y));
}

}  // namespace clatter::dynamics
