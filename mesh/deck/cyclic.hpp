#pragma once
// A sector that repeats about an axis, turned round into the whole ring.
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

/// Copies the sector's cells, sets, surfaces, temperatures, supports and loads round the axis and
/// joins the sides node by node. The ring has the modes of all nodal diameters, as real vectors.
/// Nodes and cells of the sector keep their places and numbers; those of copy k get a power of ten
/// above them, k times. Directions of supports and forces turn with their copy.
///
/// InputError beginning with `where` for sides whose nodes do not lie on each other when turned (to
/// 1e-4 of the sides' extent), and for what does not repeat about the axis: reference points with
/// what is on them, equations, ties, springs, masses, loads and axes of materials in other
/// directions.
void unfold(Deck* deck, const CyclicSector& sector);

}  // namespace clatter::mesh::deck
