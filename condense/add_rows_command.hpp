// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-condense add-rows part.fe.h5 --of part.rom.h5 --surface liner_2_bore -o part2.rom.h5
#include "core/base/command_line.hpp"

namespace clatter::condense {

/// Adds the command `add-rows`: the displacement of more surfaces and sets of a condensed part.
void declare_add_rows(CommandLine& program);

}  // namespace clatter::condense
