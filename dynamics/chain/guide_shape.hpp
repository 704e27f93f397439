// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shapes of guides and arms.
#include <optional>
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/chain/chain_spec.hpp"

namespace clatter::dynamics {

/// One [[chain.over.segment]]: an arc, or a list x1, y1, x2, y2, ... of points [m].
struct ArcTable {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // [m]
  double radius = 0.0;                               // [m]
  double from = 0.0, to = 0.0;                       // [deg]
};
struct SegmentTable {
  std::optional<ArcTable> arc;
  std::vector<double> line, bezier, points;
};
const keys::Keys<SegmentTable>& segment_keys();

/// The profile of a guide by its segments in running direction of the chain, and the circles by
/// which a taut chain passes it with the pins' line `height` [m] from the profile. The solid is on
/// the side around which the chain turns. InputError at `where`.
void make_guide(const std::vector<SegmentTable>& tables, const std::string& where, double height,
                ChainOver& over);

}  // namespace clatter::dynamics
