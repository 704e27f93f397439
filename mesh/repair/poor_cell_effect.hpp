#pragma once
// What poor cells cost: an estimate of the stiffness that they add, without the next stages.
//
// Walls bend: displacements are quadratic in the coordinates there, and a good quadratic cell has
// every quadratic polynomial q. A cell whose curved edges squeeze its map has not: the mesh comes
// no nearer to q than the q_h with the least
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
// How good it is: mesh/README.md, tests/mesh/poor_cells_test.cpp. It has the energy of one wall
// for all: where poor cells sit in the one place that a mode bends, the mode feels more.
#include <utility>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A cell by block and row.
using CellIndex = std::pair<int32_t, int32_t>;

/// Estimated relative change of frequencies by these cells against good ones in their place. More
/// than `kMostPoorCells` of them: every n-th is looked at and stands for n. 0 where all cells of
/// the list are linear ones: they have no quadratic field, whatever their shape.
double frequency_effect(const Mesh& mesh, const std::vector<CellIndex>& poor);
inline constexpr size_t kMostPoorCells = 2000;

}  // namespace clatter::mesh
