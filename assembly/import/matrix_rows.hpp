// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the rows of imported matrices mean: nodes, rigid motions, displacements, sets.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh.hpp"
#include "core/rom/dof_map.hpp"

namespace clatter::assembly {

/// The DoFs of the rows and their nodes.
struct MatrixRows {
  std::vector<rom::MappedDof> dofs;
  std::vector<int32_t> node;  // row of `nodes` of each DoF; -1 for a modal one
  RowMatrix nodes;            // [m]
  std::map<std::string, std::vector<int32_t>> sets;  // DoFs
};

/// x y z of each node, nodes in ascending order of their numbers; the mesh's node sets.
MatrixRows matrix_rows(const mesh::Mesh& mesh);

/// The nodes and sets of the map. InputError, beginning with `file`, when directions of one node's
/// displacements are not orthogonal.
MatrixRows matrix_rows(std::vector<rom::MappedDof> map, const std::string& file);

/// q of the unit rigid motions x, y, z, rx, ry, rz about the origin, n x 6; zero for modal DoFs,
/// (fixed-interface modes do not contribute).
Eigen::MatrixXd rigid_motions(const std::vector<rom::MappedDof>& dofs);

/// T of the nodal displacements u = T q, 3 n_nodes x `size`; DoF j is q[coordinate[j]], or held
/// when that is negative.
SparseMatrix displacement_of(const MatrixRows& layout, const std::vector<int32_t>& coordinate,
                             int32_t size);

/// Sets of the remaining coordinates; empty sets are omitted.
std::map<std::string, rom::DofSet> sets_of(const MatrixRows& layout,
                                           const std::vector<int32_t>& coordinate);

}  // namespace clatter::assembly
