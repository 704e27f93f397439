// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/modal_damping.hpp"

#include <fmt/format.h>

namespace clatter::condense {

const keys::Keys<DampingRow>& damping_row_keys() {
  static const keys::Keys<DampingRow> keys(
      "modal_damping",
      "damping of the body's eigenmodes, in addition to alpha and beta; linear between rows, "
      "constant outside",
      [](auto& key, DampingRow& row) {
        key.number("hz", row.hz, Range::positive(), "frequency, which ascends from row to row")
            .required();
        key.number("ratio", row.ratio, Range::between(0.0, 1.0), "share of critical damping")
            .required();
        key.check([](const Config& table, DampingRow& r) {
          if (r.ratio == 1.0) table.fail("ratio", "found 1 (critical), expected less");
        });
      });
  return keys;
}

rom::DampingTable damping_table(const Config& config, const std::vector<DampingRow>& rows) {
  const std::vector<Config> tables = config.tables("modal_damping");
  rom::DampingTable table;
  table.hz.resize(static_cast<Eigen::Index>(rows.size()));
  table.ratio.resize(table.hz.size());
  for (size_t k = 0; k < rows.size(); ++k) {
    table.hz[static_cast<Eigen::Index>(k)] = rows[k].hz;
    table.ratio[static_cast<Eigen::Index>(k)] = rows[k].ratio;
    if (k > 0 && rows[k].hz <= rows[k - 1].hz)
      tables[k].fail("hz", fmt::format("found {:g} after {:g}, expected rows that ascend",
                                       rows[k].hz, rows[k - 1].hz));
  }
  return table;
}

}  // namespace clatter::condense
