// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sparse M and K of the shells of a mesh, on displacements and rotations.
#include <cstdint>
#include <vector>

#include "core/fe/assemble.hpp"
#include "core/fe/shell.hpp"

namespace clatter::fe {

/// Rows and columns: displacement d of node a is 3 a + d.
struct ShellIds {
  int64_t count = 0;                 // of all rows
  std::vector<int32_t> rotation_of;  // n_nodes: row of rx; ry, rz follow; -1 for nodes of solids
};

/// The shell of a block with its directors. @param directors of the block (shell_directors.hpp).
ShellCell shell_cell(const mesh::Mesh& mesh, const mesh::ShellBlock& block, Eigen::Index cell,
                     const RowMatrix& directors, const ShellSection& section,
                     const Material& material);

using ShellEntries = std::vector<Eigen::Triplet<double, int32_t>>;

/// Appends the lower triangle of the matrix of a cell (6n x 6n) at its rows.
void add_lower(const ShellMatrix& values, const mesh::ShellBlock& block, Eigen::Index cell,
               const ShellIds& ids, ShellEntries& entries);

/// M and K of the shells, count x count, lower triangles. InputError names a cell that is none.
///
/// `rigid_of_node` (n_nodes, or empty) is the rigid body that a node's displacements and rotations
/// follow, or -1: the stiffness of a cell in one body is omitted. `blocks`: those of mesh.shells to
/// assemble; empty: all. Directors are those of all shells.
NodalMatrices assemble_shells(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                              const std::vector<ShellSection>& sections, const ShellIds& ids,
                              MassForm mass = MassForm::kConsistent,
                              const std::vector<int32_t>& rigid_of_node = {},
                              const std::vector<bool>& blocks = {});

}  // namespace clatter::fe
