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

Spline read_damping(const Config& table, const std::filesystem::path& path, double fallback) {
  if (!table.has("damping_column"))
    return {Spline::Kind::kLinear,
            {0.0},
            {table.number_or("damping_n_s_m", fallback, Range::between(0.0, 1e15))}};
  CsvColumns csv = read_columns({path, table.text("damping_column"), "m", "N s/m"});
  for (size_t k = 0; k < csv.y.size(); ++k)
    if (csv.y[k] < 0.0)
      throw InputError(
          fmt::format("{}:{}: {}: found {:g} N s/m, expected a damping that is not "
                      "below 0",
                      path.string(), csv.lines[k], csv.name, csv.y[k]));
  return {Spline::Kind::kMonotoneCubic, std::move(csv.x), std::move(csv.y)};
}

}  // namespace

RisingTable read_rising_table(const RisingColumn& column) {
  CsvColumns csv = read_columns(column);
  return with_context(fmt::format("{}:{}: {}", column.path.string(), csv.lines.front(), csv.name),
                      [&] { return RisingTable(std::move(csv.x), std::move(csv.y)); });
}

RadialTable read_radial_table(const Config& table, double damping,
                              std::vector<std::filesystem::path>& files) {
  files.push_back(table.path("table"));
  const std::filesystem::path& path = files.back();
  RisingTable force = read_rising_table({path, table.text_or("column", "force"), "m", "N"});
  return {std::move(force), read_damping(table, path, damping)};
}

}  // namespace clatter::dynamics
