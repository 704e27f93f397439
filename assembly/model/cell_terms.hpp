// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the cells of a mesh add to the model.
#include "assembly/constraint/constrain.hpp"
#include "core/fe/assemble.hpp"
#include "core/fe/assemble_shells.hpp"

namespace clatter::assembly {

/// K and M of solids and shells, lower triangles; on all ids where there are shells.
fe::NodalMatrices cell_matrices(const PartData& part, const Constrained& constrained,
                                const fe::NodePattern& pattern);

/// Their loss factors times stiffness: the derivative of K by e where each modulus is 1 + e eta
/// times its value, of layers with the transverse shear that follows. 0 x 0 without loss factors.
SparseMatrix loss_of_cells(const PartData& part, const Constrained& constrained,
                           const fe::NodePattern& pattern);

/// Adds the geometric stiffness of [prestress] to K, on all ids, and says how much it is.
void add_prestress(const PartData& part, const fe::NodePattern& pattern, SparseMatrix& K);

fe::ShellIds shell_ids(const DofNumbers& numbers, Eigen::Index n_nodes);

/// `to` += `more`, which may have more rows and columns, as all ids, or none.
void add(SparseMatrix& to, const SparseMatrix& more);

}  // namespace clatter::assembly
