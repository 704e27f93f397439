// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The mesh for Gmsh.
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// MSH 2.2 text, lengths in metres. Physical groups: regions are solids or faces, surfaces are
/// faces, node sets are points; a face or node in two groups is written as two elements, and so is
/// a shell in a surface. Nodes and cells keep their numbers; faces and points are numbered after
/// the cells. read_mesh_file() (deck/msh/reader.hpp) reads the same mesh back, except the fields,
/// and refuses shells, which are no faces of solids. InputError for a name with '"'.
std::string msh_text(const Mesh& mesh);

}  // namespace clatter::mesh
