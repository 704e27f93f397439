// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-recover listen slap.field.h5 slap.wav --microphone plus_y
#include "core/base/command_line.hpp"

namespace clatter::recover {

/// Adds the command `listen`: the pressure at a microphone as a WAV file.
void declare_listen(CommandLine& program);

}  // namespace clatter::recover
