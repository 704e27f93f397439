// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-condense predict part.fe.h5 --ranks 32 [-c part.rom.toml]
#include "core/base/command_line.hpp"

namespace clatter::condense {

/// Declares the command `predict`: what the condensation will cost.
void declare_predict(CommandLine& program);

}  // namespace clatter::condense
