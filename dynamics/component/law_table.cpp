// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/law_table.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "dynamics/given/csv_table.hpp"

namespace clatter::dynamics {
namespace {

CsvColumns read_columns(const RisingColumn& wanted) {
  CsvColumns csv = read_csv(wanted.path, wanted.column);
  if (csv.abscissa_unit != wanted.abscissa_unit || csv.unit != wanted.unit)
    throw InputError(
        fmt::format("{}:{}: found {} in [{}] over [{}], expected units of [{}] over [{}]",
                    wanted.path.string(), csv.lines.front() - 1, csv.name, csv.unit,
                    csv.abscissa_unit, wanted.unit, wanted.abscissa_unit));
  return csv;
}

Spline read_damping(const RadialTableSpec& spec, double damping) {
  if (spec.damping_column.empty()) return {Spline::Kind::kLinear, {0.0}, {damping}};
  CsvColumns csv = read_columns({spec.file, spec.damping_column, "m", "N s/m"});
  for (size_t k = 0; k < csv.y.size(); ++k)
    if (csv.y[k] < 0.0)
      throw InputError(
          fmt::format("{}:{}: {}: found {:g} N s/m, expected a damping that is not "
                      "below 0",
                      spec.file.string(), csv.lines[k], csv.name, csv.y[k]));
  return {Spline::Kind::kMonotoneCubic, std::move(csv.x), std::move(csv.y)};
}

}  // namespace

RisingTable read_rising_table(const RisingColumn& column) {
  CsvColumns csv = read_columns(column);
  return with_context(fmt::format("{}:{}: {}", column.path.string(), csv.lines.front(), csv.name),
                      [&] { return RisingTable(std::move(csv.x), std::move(csv.y)); });
}

RadialTable read_radial_table(const RadialTableSpec& spec, double damping) {
  return {read_rising_table({spec.file, spec.column, "m", "N"}), read_damping(spec, damping)};
}

}  // namespace clatter::dynamics
