// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-dynamics scene.run.toml -o scene.run.h5
#include "core/base/command_line.hpp"

namespace clatter::dynamics {

/// Declares what the program does: a scene in the time domain. SIGINT and SIGTERM end the run after
/// a step with a valid file.
void declare_run(CommandLine& program);

}  // namespace clatter::dynamics
