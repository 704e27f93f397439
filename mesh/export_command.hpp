// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-mesh export part.mesh.h5 part.vtu
#include "core/base/command_line.hpp"

namespace clatter::mesh {

/// Adds the command `export`: a finished mesh in formats of other programs.
void declare_export(CommandLine& program);

}  // namespace clatter::mesh
