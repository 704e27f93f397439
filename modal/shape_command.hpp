// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// `clatter-modal shape`: the radial shape of a cylinder surface in static results.
#include "core/base/command_line.hpp"

namespace clatter::modal {

/// Adds the command `shape` to the program.
void declare_shape(CommandLine& program);

}  // namespace clatter::modal
