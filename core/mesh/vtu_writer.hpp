// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mesh output for ParaView and other programs that read VTK XML.
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A binary .vtu (appended raw data), node orders of VTK:
///
///   point data   `id` of each node, every node set as a flag of its name, every field
///   cell data    `id`, `region` (index)
///                a mesh without cells is represented by the faces of its surface "skin"
///   field data   "region NAME" = its index; "surface NAME TYPE" = node rows of its faces, one row
///   per
///                face, in the order of cell.hpp, which equals VTK's; outward
std::string vtu_text(const Mesh& mesh);

}  // namespace clatter::mesh
