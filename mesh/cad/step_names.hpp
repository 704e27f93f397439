// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace clatter::mesh {

/// From now on the names of faces in STEP files are the names of Gmsh's entities, which
/// otherwise have those of solids alone.
void keep_step_names();

}  // namespace clatter::mesh
