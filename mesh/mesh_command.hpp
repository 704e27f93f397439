// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-mesh part.mesh.toml -o part.mesh.h5
#include "core/base/command_line.hpp"

namespace clatter::mesh {

/// Declares what the program does without a command: the mesh of a description, CAD file or deck.
void declare_mesh(CommandLine& program);

}  // namespace clatter::mesh
