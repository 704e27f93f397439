// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/node_frames.hpp"

#include <Eigen/Geometry>
#include <array>
#include <optional>

namespace clatter::condense {
namespace {

using Axes = std::array<std::optional<Eigen::Vector3d>, 3>;

Eigen::Matrix3d completed(const Axes& axes) {
  Eigen::Matrix3d frame = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Index> known, other;
  for (Eigen::Index d = 0; d < 3; ++d) {
    const auto& axis = axes[d];
    (axis ? known : other).push_back(d);
    if (axis) frame.col(d) = *axis;
  }
  if (known.size() == 1) {
    frame.col(other.front()) = frame.col(known.front()).unitOrthogonal();
    other.erase(other.begin());
  }
  if (!other.empty()) {
    const Eigen::Index d = other.front();
    frame.col(d) = frame.col((d + 1) % 3).cross(frame.col((d + 2) % 3));
  }
  return frame;
}

}  // namespace

std::map<int, Eigen::Matrix3d> frames_of(const std::vector<rom::MappedDof>& map) {
  std::map<int, Axes> axes;
  for (const rom::MappedDof& dof : map)
    if (dof.turned) axes[dof.node][(dof.component - 1) % 3] = dof.direction;
  std::map<int, Eigen::Matrix3d> frames;
  for (const auto& [node, of_node] : axes) frames[node] = completed(of_node);
  return frames;
}

}  // namespace clatter::condense
