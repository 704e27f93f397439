// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nodes of a reduced part and their motion in its elastic modes, for floating frames of reference.
#include <Eigen/Core>
#include <vector>

#include "condense/export/exported_part.hpp"
#include "condense/export/pencil_modes.hpp"

namespace clatter::condense {

struct NodeShape {
  int number = 0;
  Eigen::Vector3d position;
  Eigen::MatrixXd shape;  // 6 x modes: x y z rx ry rz
};

/// The nodes at the positions of the boundary coordinates, by number. A coordinate along direction
/// d moves its node by d times its value; directions without a coordinate are zero. InputError when
/// there is none.
std::vector<NodeShape> node_shapes(const ExportedPart& part, const PencilModes& modes);

}  // namespace clatter::condense
