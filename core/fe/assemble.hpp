// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Assembly of sparse M and K of a mesh on nodal displacements.
#include <vector>

#include "core/base/sparse.hpp"
#include "core/fe/material.hpp"
#include "core/fe/pattern.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// M q'' + K q = f on 3 n_nodes nodal displacements, node-major (3 a + d); lower triangles.
struct NodalMatrices {
  SparseMatrix M;  // [kg]
  SparseMatrix K;  // [N/m], singular: six rigid-body motions
};

/// Assembles all cells; `materials` has one entry per region of the mesh.
///
/// Cells are processed in chunks: their matrices are computed in parallel, then added in parallel,
/// each thread to the columns of its own nodes and in cell order, so that the result does not
/// depend on the thread count. Beyond M, K and the pattern only one chunk is held. InputError names
/// an inverted cell.
///
/// `rigid_of_node` (n_nodes, or empty) is the rigid body of each node, or -1: a cell whose nodes
/// all belong to one body does not deform; its stiffness is omitted, since elimination would leave
/// rounding errors of it.
NodalMatrices assemble(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                       const NodePattern& pattern, MassForm mass = MassForm::kConsistent,
                       const std::vector<int32_t>& rigid_of_node = {});

}  // namespace clatter::fe
