#pragma once
// The mesh for Gmsh.
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// MSH 2.2 text, lengths in metres. Physical groups: regions are solids, surfaces are faces, node
/// sets are points; a face or node that is in two groups stands there as two elements. Nodes and
/// cells keep their numbers; faces and points are numbered after the cells. read_msh()
/// (msh_reader.hpp) gives the same mesh back, but for the fields. InputError for a name with '"'.
std::string msh_text(const Mesh& mesh);

}  // namespace clatter::mesh
