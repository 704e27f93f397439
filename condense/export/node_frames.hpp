// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Axes of nodes whose components are not along x, y, z.
#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/rom/dof_map.hpp"

namespace clatter::condense {

/// By node, of those with turned components: columns are the axes of components 1 to 3,
/// right-handed and orthonormal. Axes that no coordinate has complete the others.
std::map<int, Eigen::Matrix3d> frames_of(const std::vector<rom::MappedDof>& map);

}  // namespace clatter::condense
