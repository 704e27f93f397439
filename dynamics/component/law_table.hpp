// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Laws of joints as CSV tables.
#include <filesystem>
#include <string>

#include "dynamics/component/component_keys.hpp"
#include "dynamics/law/radial_table.hpp"

namespace clatter::dynamics {

/// A column of a CSV file that rises from 0 over its first column.
struct RisingColumn {
  std::filesystem::path path;  // of the file
  std::string column;
  std::string abscissa_unit, unit;  // SI, as csv_table.hpp names them
};
/// InputError "file:line: ..." for other units, and as RisingTable.
RisingTable read_rising_table(const RisingColumn& column);

/// A law of force over displacement, as its keys say.
struct RadialTableSpec {
  std::filesystem::path file;  // empty: there is none
  std::string column = "force", damping_column;
};
/// Rows column, damping_column and table; the result is that of the table.
template <class S>
keys::Row radial_table_rows(Keys<S>& key, RadialTableSpec& law) {
  key.text("column", law.column, "column of the force").needs("table");
  key.text("damping_column", law.damping_column, "column of the damping, instead of damping_n_s_m")
      .needs("table");
  return key.path("table", law.file, "CSV of force over displacement, which rises from 0 at 0");
}
/// @param damping without a column of it [N s/m].
RadialTable read_radial_table(const RadialTableSpec& spec, double damping);

}  // namespace clatter::dynamics
