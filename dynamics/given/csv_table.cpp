// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/csv_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kLargest = 1e20;  // of any number of a table, in its unit (hard case S7)

struct Unit {
  std::string si;
  double factor;
  double offset = 0.0;
};

const std::map<std::string, Unit>& units() {
  static const std::map<std::string, Unit> table{{"deg", {"rad", std::numbers::pi / 180.0}},
                                                 {"rad", {"rad", 1.0}},
                                                 {"rad/s", {"rad/s", 1.0}},
                                                 {"rpm", {"rad/s", std::numbers::pi / 30.0}},
                                                 {"s", {"s", 1.0}},
                                                 {"ms", {"s", 1e-3}},
                                                 {"us", {"s", 1e-6}},
                                                 {"Pa", {"Pa", 1.0}},
                                                 {"kPa", {"Pa", 1e3}},
                                                 {"bar", {"Pa", 1e5}},
                                                 {"MPa", {"Pa", 1e6}},
                                                 {"N", {"N", 1.0}},
                                                 {"kN", {"N", 1e3}},
                                                 {"N m", {"N m", 1.0}},
                                                 {"N/m", {"N/m", 1.0}},
                                                 {"N/mm", {"N/m", 1e3}},
                                                 {"N s/m", {"N s/m", 1.0}},
                                                 {"N s/mm", {"N s/m", 1e3}},
                                                 {"m", {"m", 1.0}},
                                                 {"mm", {"m", 1e-3}},
                                                 {"um", {"m", 1e-6}},
                                                 {"K", {"K", 1.0}},
                                                 {"degC", {"K", 1.0, 273.15}},
                                                 {"1", {"1", 1.0}}};
  return table;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  const char separator = line.find(';') != std::string::npos ? ';' : ',';
  size_t begin = 0;
  for (;;) {
    const auto end = line.find(separator, begin);
    result.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == std::string::npos) return result;
    begin = end + 1;
  }
}

struct Heading {
  std::string name;
  Unit unit;
};

Heading heading(const std::string& cell, const std::string& position) {
  const auto open = cell.find('['), close = cell.find(']');
  if (open == std::string::npos || close == std::string::npos || close < open) {
    throw InputError(
        fmt::format("{}: found \"{}\", expected a name with its unit in brackets, as \"time [s]\", "
                    "\"pressure [bar]\"",
                    position, cell));
  }
  const auto unit = trimmed(cell.substr(open + 1, close - open - 1));
  const auto found = units().find(unit);
  if (found == units().end()) {
    std::vector<std::string> known;
    for (const auto& entry : units()) known.push_back(entry.first);
    throw InputError(
        fmt::format("{}: unit [{}], expected one of: {}", position, unit, fmt::join(known, ", ")));
  }
  return {trimmed(cell.substr(0, open)), found->second};
}

/// Refuses the name of the last column where an earlier one has it.
void refuse_repeated(const std::vector<Heading>& headings, const std::string& position) {
  for (size_t i = 0; i + 1 < headings.size(); ++i)
    if (headings[i].name == headings.back().name)
      throw InputError(
          fmt::format("{}: columns {} and {} are both \"{}\", expected different names", position,
                      i + 1, headings.size(), headings[i].name));
}

double number(const std::string& cell, const std::string& position, const std::string& column) {
  double value = 0.0;
  const auto* begin = cell.data();
  const auto* end = begin + cell.size();
  const auto parsed = std::from_chars(begin, end, value);
  if (cell.empty() || parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) {
    throw InputError(
        fmt::format("{}: {}: found \"{}\", expected a finite number", position, column, cell));
  }
  if (std::abs(value) > kLargest) {
    throw InputError(fmt::format("{}: {}: found \"{}\", expected a number from {:g} to {:g}",
                                 position, column, cell, -kLargest, kLargest));
  }
  return value;
}

size_t column_index(const std::vector<Heading>& headings, const std::string& column,
                    const std::string& position) {
  if (headings.size() < 2) {
    throw InputError(fmt::format("{}: found one column, expected at least two", position));
  }
  if (column.empty()) return 1;
  std::vector<std::string> names;
  for (size_t i = 1; i < headings.size(); ++i) {
    if (headings[i].name == column) return i;
    names.push_back(headings[i].name);
  }
  throw InputError(
      fmt::format("{}: no column \"{}\", found: {}", position, column, fmt::join(names, ", ")));
}

}  // namespace

CsvColumns read_csv(const std::filesystem::path& path, const std::string& column) {
  std::ifstream stream(path);
  if (!stream || std::filesystem::is_directory(path)) {
    throw InputError(fmt::format("{}: no such file, expected a CSV table", path.string()));
  }
  CsvColumns table;
  std::vector<Heading> headings;
  size_t picked = 1;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (trimmed(text).empty() || trimmed(text)[0] == '#') continue;
    const auto position = fmt::format("{}:{}", path.string(), line);
    const auto row = cells(text);
    if (headings.empty()) {
      for (const auto& cell : row) {
        headings.push_back(heading(cell, position));
        refuse_repeated(headings, position);
      }
      picked = column_index(headings, column, position);
      table.abscissa_name = headings[0].name;
      table.abscissa_unit = headings[0].unit.si;
      table.name = headings[picked].name;
      table.unit = headings[picked].unit.si;
      continue;
    }
    if (row.size() != headings.size()) {
      throw InputError(
          fmt::format("{}: found {} cells, expected {}", position, row.size(), headings.size()));
    }
    const auto converted = [&](size_t i) {
      const Unit& unit = headings[i].unit;
      return number(row[i], position, headings[i].name) * unit.factor + unit.offset;
    };
    const double x = converted(0);
    if (!table.x.empty() && !(x > table.x.back())) {
      throw InputError(
          fmt::format("{}: {}: found {} after a row that is not below it, expected "
                      "ascending values",
                      position, table.abscissa_name, row[0]));
    }
    table.x.push_back(x);
    table.y.push_back(converted(picked));
    table.lines.push_back(line);
  }
  if (table.x.empty()) {
    throw InputError(fmt::format("{}: found no rows of numbers below a header", path.string()));
  }
  return table;
}

void require_covered(const CsvColumns& table, const std::filesystem::path& path, double begin,
                     double end) {
  constexpr double kRounding = 1e-9;  // of the span
  const double slack = kRounding * (end - begin);
  if (table.x.front() <= begin + slack && table.x.back() >= end - slack) return;
  throw InputError(
      fmt::format("{}:{}: the table covers {:.12g} to {:.12g} s, expected {:.12g} to "
                  "{:.12g} s",
                  path.string(), table.lines.back(), table.x.front(), table.x.back(), begin, end));
}

}  // namespace clatter::dynamics
