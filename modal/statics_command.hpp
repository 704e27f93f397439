// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-modal statics part.fe.h5 -o part.static.h5
#include "core/base/command_line.hpp"

namespace clatter::modal {

/// Adds the command `statics`: displacements, reactions and stresses of load cases.
void declare_statics(CommandLine& program);

}  // namespace clatter::modal
