// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as superelements: their boundary nodes are nodes of the mesh, so that ties,
// couplings, springs and supports act on them as on any other; their other coordinates are ids of
// their own.
#include <vector>

#include "assembly/recipe/recipe.hpp"
#include "core/mesh/mesh.hpp"
#include "core/recipe/recipe.hpp"

namespace clatter::assembly {

/// Reads and places the parts of a file and adds to the mesh:
/// - a node wherever a set has three displacements along orthogonal directions at one position,
///   with rotations where it has three of these too, or two about axes of the assembly;
/// - a node set for each set with such nodes, a surface for each with faces between them.
/// InputError for parts that are not free to move, for names that the mesh has, and for damping
/// that differs between the parts where the file has none of its own.
std::vector<PartSpec> attach_parts(const recipe::File& file, mesh::Mesh& mesh);

}  // namespace clatter::assembly
