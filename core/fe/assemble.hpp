#pragma once
// Sparse M and K of a mesh, on nodal displacements.
#include <vector>

#include "core/base/sparse.hpp"
#include "core/fe/material.hpp"
#include "core/fe/pattern.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// M q'' + K q = f on 3 n_nodes nodal displacements, node-major (3 a + d); lower triangles.
struct NodalMatrices {
  SparseMatrix M;  // [kg]
  SparseMatrix K;  // [N/m], singular: six rigid motions
};

/// Consistent mass, or its diagonal scaled to the same total (lump_hrz): M is diagonal then.
enum class MassForm { kConsistent, kHrz };

/// Assembles all cells; `materials` has one entry a region of the mesh.
///
/// Cells go through in chunks: their matrices are computed in parallel, then added in parallel,
/// each thread to the columns of its own nodes and in the order of the cells. So every entry is
/// summed in one order, and the bits do not depend on the thread count. Beyond M, K and the
/// pattern only one chunk is held. InputError names an inverted cell.
///
/// `rigid_of_node` (n_nodes, or none) says which rigid body a node belongs to, -1 for no one: a
/// cell whose nodes all belong to one body does not deform, and its stiffness, of which elimination
/// would leave rounding, is left out.
NodalMatrices assemble(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                       const NodePattern& pattern, MassForm mass = MassForm::kConsistent,
                       const std::vector<int32_t>& rigid_of_node = {});

}  // namespace clatter::fe
