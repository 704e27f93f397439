// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Modal damping of the `.rom.toml`.
#include "core/base/config.hpp"
#include "core/rom/damping_table.hpp"

namespace clatter::condense {

/// Rows [[modal_damping]] hz = 500.0, ratio = 0.01 of a `.rom.toml`; empty when there are none.
/// InputError at the row's line when frequencies do not ascend or a ratio is not below critical.
rom::DampingTable read_modal_damping(const Config& config);

}  // namespace clatter::condense
