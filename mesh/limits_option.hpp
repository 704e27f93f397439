// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The limits of the child processes that run gmsh, as options.
#include "core/base/child_process.hpp"
#include "core/base/command_line.hpp"

namespace clatter::mesh {

/// Declares --time-limit and --memory-limit.
void declare_limits(CommandLine& line, ChildLimits& limits);

/// InputError unless the time is 0 or more.
void check_limits(const ChildLimits& limits);

}  // namespace clatter::mesh
