// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Whether the node that is nearest to a requested position can stand for it.
#include <Eigen/Core>
#include <string>

#include "core/base/matrix.hpp"

namespace clatter {

/// The largest diagonal of the bounding boxes of those cells or faces that have `node` [m]; 0 when
/// none has.
/// @param cells each a row of nodes
double size_around(const RowMatrix& nodes, const IndexMatrix& cells, int32_t node);

/// Says how far the nearest node lies from the requested position.
/// @param what "sensor 'top': the nearest node of the skin"
/// @param size of the elements there [m]; 0 where there are none: any distance will do
/// @param unit of positions as the user writes them, "metres" or "length_unit"
/// @throws InputError when it lies farther than `size`: with the node's position, and with the unit
/// in which the request would fit
void require_near(const std::string& what, const Eigen::Vector3d& requested,
                  const Eigen::Vector3d& found, double size, const std::string& unit);

}  // namespace clatter
