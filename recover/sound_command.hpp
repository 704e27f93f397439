// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-recover sound part.rom.h5 -o part.sound.h5
#include "core/base/command_line.hpp"

namespace clatter::recover {

/// Adds the command `sound`: radiated power and microphones of a part over frequency.
void declare_sound(CommandLine& program);

}  // namespace clatter::recover
