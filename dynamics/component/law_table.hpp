// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Laws of joints as CSV tables.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/force/radial_table.hpp"

namespace clatter::dynamics {

/// A column of a CSV file that rises from 0 over its first column.
struct RisingColumn {
  std::filesystem::path path;  // of the file
  std::string column;
  std::string abscissa_unit, unit;  // SI, as csv_table.hpp names them
};
/// InputError "file:line: ..." for other units, and as RisingTable.
RisingTable read_rising_table(const RisingColumn& column);

/// A law of force over displacement: keys `table`, `column` = "force", and `damping_column` or
/// `damping_n_s_m`, of which the default is `damping` [N s/m]. The file is appended to `files`.
RadialTable read_radial_table(const Config& table, double damping,
                              std::vector<std::filesystem::path>& files);

}  // namespace clatter::dynamics
