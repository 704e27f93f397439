// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gmsh and OpenCASCADE in a child process: both crash on real CAD files and corrupt meshes, by
// signals, by exit and by throwing across callbacks (hard case N17).
#include <filesystem>
#include <string>

#include "core/base/child_process.hpp"
#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {

/// What Gmsh was doing: its last progress message ("Meshing surface 7 (Cylinder,
/// Frontal-Delaunay)"), else the step of gmsh_call().
std::string last_step(const ChildEnd& end);

/// "gmsh crashed (signal 11, Segmentation fault) at: Meshing surface 7 (...)", with the last line
/// of stderr.
std::string describe_end(const ChildEnd& end, const ChildLimits& limits);

/// The same limits, with news of Gmsh's work: "mesh: still at: Optimizing mesh ..., 2 min so far".
ChildLimits with_news(ChildLimits limits);

/// Reads an MSH file with Gmsh in a child process. InputError for errors and crashes of Gmsh;
/// NumericsError when a limit ended it.
MshContents read_msh_contents(const std::filesystem::path& path, const ChildLimits& limits);

}  // namespace clatter::mesh
