// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Modal damping of the `.rom.toml`.
#include <vector>

#include "core/keys/keys.hpp"
#include "core/rom/damping_table.hpp"

namespace clatter::condense {

/// A row [[modal_damping]].
struct DampingRow {
  double hz = 0.0, ratio = 0.0;
};
const keys::Keys<DampingRow>& damping_row_keys();

/// The rows as a table. InputError at a row's line when frequencies do not ascend.
rom::DampingTable damping_table(const Config& config, const std::vector<DampingRow>& rows);

}  // namespace clatter::condense
