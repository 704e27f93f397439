// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-condense export part.rom.h5 part.mtx
#include "core/base/command_line.hpp"

namespace clatter::condense {

/// Adds the command `export`: a reduced part in formats of other programs.
void declare_export(CommandLine& program);

}  // namespace clatter::condense
