// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Divides the nodes of a surface into compact groups.
#include <cstdint>
#include <vector>

#include "core/base/matrix.hpp"

namespace clatter::assembly {

/// Groups of at most `limit` nodes each, by recursive bisection at the median of the longest
/// extent. `coordinates` n x 3; each node is in one group. Node numbers decide only between nodes
/// of one position.
std::vector<std::vector<int32_t>> cluster_nodes(const RowMatrix& coordinates,
                                                const std::vector<int32_t>& nodes, size_t limit);

}  // namespace clatter::assembly
