// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to the files that mesh by Gmsh.
#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {

/// Sets Gmsh's algorithm on faces, its options of sizes, fields and callback.
void set_sizes(const SizeSettings& settings);

}  // namespace clatter::mesh
