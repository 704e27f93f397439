// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-mesh faces part.step
#include "core/base/command_line.hpp"

namespace clatter::mesh {

/// Adds the command `faces`: the faces of a CAD file or a part.mesh.toml as a table, by --json as
/// one line, with -o also with their triangles in a file for `clatter plot faces`.
void declare_faces(CommandLine& program);

}  // namespace clatter::mesh
