// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Coordinate systems of a deck in the basic frame.
//
// A, B, C of CORD2 (grids of CORD1): origin, a point of the z axis, a point of the xz plane.
// Coordinates and directions: rectangular x y z; cylindrical r theta z; spherical r theta phi,
// where theta is measured from the z axis and phi about it (MSC Nastran Quick Reference Guide,
// CORD2C, CORD2S). Angles in degrees. Numbers: those of the deck, 0 is the basic system.
#include <Eigen/Core>
#include <array>
#include <map>

#include "mesh/deck/id_index.hpp"
#include "mesh/deck/nastran/raw_deck.hpp"

namespace clatter::mesh::deck::nastran {

/// Components of a card as a vector.
Eigen::Vector3d vector(const std::array<double, 3>& v);

class Systems {
 public:
  /// Follows references in any order. InputError for a missing system, for cycles and for points
  /// that define no axes. The grids' coordinates are those of the deck.
  Systems(const RawDeck& raw, const IdIndex& grids, const Source& source);

  /// Position in the basic frame. InputError (origin) for an unknown system.
  Eigen::Vector3d to_basic(int32_t system, const Eigen::Vector3d& local, Origin origin) const;
  /// Columns: the system's directions at a point of the basic frame, in basic components.
  Eigen::Matrix3d directions(int32_t system, const Eigen::Vector3d& at, Origin origin) const;
  const System& get(int32_t system, Origin origin) const;

 private:
  friend class SystemsBuilder;
  const Source& source_;
  std::map<int32_t, System> systems_;  // 0 is the basic one
};

}  // namespace clatter::mesh::deck::nastran
