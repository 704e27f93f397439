// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-modal part.fe.h5 -o part.modes.h5
#include "core/base/command_line.hpp"

namespace clatter::modal {

/// Declares what the program does without a command: modes of an assembled or reduced part, with a
/// proof that none is missing.
void declare_modes(CommandLine& program);

}  // namespace clatter::modal
