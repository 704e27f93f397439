#pragma once
// The mesh for ParaView and other programs that read VTK's XML.
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A binary .vtu (appended raw data), node orders of VTK:
///
///   point data   `id` of each node, every node set as a flag under its name, every field
///   cell data    `id`, `region` (index)
///                a mesh without cells is drawn by the faces of its surface "skin"
///   field data   "region NAME" = its index; "surface NAME TYPE" = node rows of its faces, one row
///                a face, in the order of cell.hpp, which is VTK's for faces; outward
std::string vtu_text(const Mesh& mesh);

}  // namespace clatter::mesh
