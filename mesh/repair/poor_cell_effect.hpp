// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effect of poor cells: an estimate of the stiffness that they add, without the next stages.
//
// Walls bend: displacements are quadratic in the coordinates there, and a good quadratic cell has
// every quadratic polynomial q. A cell whose curved edges distort its map has not: the best
// approximation of q on the mesh is the q_h with the least
//
//   X(q) = integral of |grad (q - q_h)|^2 dV
//
// over the poor cells and those around them, where the nodes of poor cells are free and all others
// have the values of q. With the mean X of six polynomials whose second derivatives are orthonormal
// (x^2/2, y^2/2, z^2/2, xy/sqrt 2, xz/sqrt 2, yz/sqrt 2), and bending of a wall of the part's mean
// thickness t = 2 V / A by the curvature k, |grad grad u|^2 = 3 k^2 (w = k x^2 / 2, u = -k x z) and
// energy per volume E k^2 t^2 / 24:
//
//   relative change of omega^2 = 3 X / (V t^2 / 12),   of the frequency half of that.
//
// Accuracy: mesh/README.md, tests/mesh/poor_cells_test.cpp. It assumes the same bending energy
// everywhere: a mode that bends mainly at the poor cells changes more.
#include <utility>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A cell: block and row.
using CellIndex = std::pair<int32_t, int32_t>;

/// Estimated relative change of frequencies by these cells, compared with good ones. Of more than
/// `kMostPoorCells`, every n-th is evaluated and counts n times. 0 if all cells of the list are
/// linear: they have no quadratic field, whatever their shape.
double frequency_effect(const Mesh& mesh, const std::vector<CellIndex>& poor);
inline constexpr size_t kMostPoorCells = 2000;

}  // namespace clatter::mesh
