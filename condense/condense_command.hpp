// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-condense part.fe.h5 -c part.rom.toml -o part.rom.h5
#include "core/base/command_line.hpp"

namespace clatter::condense {

/// Declares what the program does without a command: the reduction of an assembled part.
void declare_condense(CommandLine& program);

}  // namespace clatter::condense
