// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-dynamics response: the motion of a body under one of the forces of a run.
#include "core/base/command_line.hpp"

namespace clatter::dynamics {

/// Adds the command to the program.
void declare_response(CommandLine& program);

}  // namespace clatter::dynamics
