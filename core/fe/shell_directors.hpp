// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Normals of a shell at the nodes of its cells.
#include <vector>

#include "core/fe/shell.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// By block: one row per cell, three columns per node. The director of a node in a cell is the mean
/// of the normals there of the cells around the node that lie within 20 degrees of its own,
/// whatever their side: at sharper folds, and where more than two sheets meet, each side keeps its
/// own.
/// Components of rounding are 0: a rotation about the axis that is left has no mass then, instead
/// of one of the square of rounding (hard case U7).
std::vector<RowMatrix> shell_directors(const RowMatrix& nodes,
                                       const std::vector<mesh::ShellBlock>& shells);

}  // namespace clatter::fe
