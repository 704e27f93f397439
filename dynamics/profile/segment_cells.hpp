// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From segments to the cells of a profile.
#include <vector>

#include "dynamics/profile/circle_tree.hpp"
#include "dynamics/profile/profile_cell.hpp"
#include "dynamics/profile/segment.hpp"

namespace clatter::dynamics {

/// Cells of a sequence of segments, with the cubics they refer to.
struct SegmentCells {
  std::vector<ProfileCell> cells;
  std::vector<Cubic> cubics;
  std::vector<size_t> first;  // of each segment: its first cell

  /// Appends the cells of a segment, which turn by at most 180 deg on an arc and about 0.2 rad on a
  /// cubic. InputError for a segment without length, tangent or finite numbers.
  void add(const Segment& segment);

  CurvePoint begin(size_t segment) const;
  CurvePoint end(size_t segment) const;
};

/// A circle that contains the cell.
Circle bounding_circle(const ProfileCell& cell, const std::vector<Cubic>& cubics);

}  // namespace clatter::dynamics
