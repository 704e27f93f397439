// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Expansion of a cyclic sector to the full ring.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

struct CyclicSector {
  std::string where;                                // for messages
  int32_t count = 0;                                // sectors of the ring
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // of the axis
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit vector
  std::vector<int32_t> one, other;                  // nodes of the mesh on the two sides
};

/// Copies the sector's cells, sets, surfaces, temperatures, supports and loads around the axis and
/// joins the sides node by node. The ring has the modes of all nodal diameters, as real vectors.
/// Nodes and cells of the sector keep their positions and numbers; those of copy k add k times a
/// power of ten. Directions of supports and forces rotate with their copy.
///
/// InputError beginning with `where` for sides whose nodes do not coincide after rotation (to 1e-4
/// of the sides' extent), and for what cannot be repeated about the axis: reference points with
/// their couplings, equations, ties, springs, masses, loads and material axes in other directions.
void unfold(Deck& deck, const CyclicSector& sector);

}  // namespace clatter::mesh::deck
