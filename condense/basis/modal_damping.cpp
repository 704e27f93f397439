// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/modal_damping.hpp"

#include <fmt/format.h>

namespace clatter::condense {

rom::DampingTable read_modal_damping(const Config& config) {
  const std::vector<Config> rows = config.tables("modal_damping");
  rom::DampingTable table;
  table.hz.resize(static_cast<Eigen::Index>(rows.size()));
  table.ratio.resize(table.hz.size());
  for (Eigen::Index k = 0; k < table.hz.size(); ++k) {
    const Config& row = rows[static_cast<size_t>(k)];
    table.hz[k] = row.number("hz", Range::positive());
    table.ratio[k] = row.number("ratio", {0.0, 1.0});
    if (table.ratio[k] == 1.0) row.fail("ratio", "found 1 (critical), expected less");
    if (k > 0 && table.hz[k] <= table.hz[k - 1])
      row.fail("hz", fmt::format("found {:g} after {:g}, expected rows that ascend", table.hz[k],
                                 table.hz[k - 1]));
  }
  return table;
}

}  // namespace clatter::condense
