// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// CSV tables: a header with units, then rows of numbers.
#include <filesystem>
#include <string>
#include <vector>

namespace clatter::dynamics {

/// Two columns of a CSV file in SI: the abscissa (first column) and one other.
struct CsvColumns {
  std::string abscissa_name, name;
  std::string abscissa_unit, unit;  // as converted: "rad", "s", "Pa", "N", ...
  std::vector<double> x, y;
  std::vector<int> lines;  // line in the file of each row, for messages
};

/// Reads `column` (or, when empty, the second one) of a file such as
///
///     # anything
///     crank_angle [deg], pressure [bar]
///     -180, 1.0
///
/// Separators: comma or semicolon. Units: deg, rad, rad/s, rpm, s, ms, us, Pa, kPa, bar, MPa, N,
/// kN, N m, N/m, N/mm, N s/m, N s/mm, m, mm, um, K, degC, 1; each is converted to SI. InputError
/// "file:line:
/// ..." for a missing header, an unknown unit, a name of two columns, a missing or extra cell, a
/// value that is not a finite number, an abscissa that does not ascend.
CsvColumns read_csv(const std::filesystem::path& path, const std::string& column);

/// Refuses a table over time that ends before `end` [s] or begins after `begin` [s] by more than
/// rounding.
void require_covered(const CsvColumns& table, const std::filesystem::path& path, double begin,
                     double end);

}  // namespace clatter::dynamics
