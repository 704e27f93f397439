// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The mesh for programs that read I-DEAS universal files.
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Datasets 164 (SI), 2411 (nodes), 2412 (elements) and 2467 (permanent groups), lengths in metres.
/// Solids are 111, 118 (tetrahedra), 112, 113 (wedges), 115, 116 (bricks) with the region as
/// property and material number, nodes in rings: the lower face with its mid-side nodes in turn,
/// the mid-side nodes of the upright edges, the upper face. Faces of surfaces are thin shells 91,
/// 92, 94, 95 after them, and so are shells, with their region as property: a shell that is a face
/// of surfaces is written once. Groups: a region and a surface by its elements, a node set by its
/// nodes, names of 40 characters at most. Nodes and cells keep their numbers. InputError for
/// pyramids, which the format does not have, and for longer names.
std::string unv_text(const Mesh& mesh);

}  // namespace clatter::mesh
