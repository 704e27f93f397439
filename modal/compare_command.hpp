// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-modal compare part.fe.h5 part.rom.h5
#include "core/base/command_line.hpp"

namespace clatter::modal {

/// Adds the command `compare`: modes of a reduced part against those of the full one.
void declare_compare(CommandLine& program);

}  // namespace clatter::modal
