// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/placement.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::rom {
namespace {

/// Faces from their other side: corners, then the nodes in the middle of their edges.
void reverse_faces(IndexMatrix& faces) {
  const Eigen::Index corners = faces.cols() > 4 ? faces.cols() / 2 : faces.cols();
  faces.leftCols(corners).rowwise().reverseInPlace();
  if (faces.cols() > corners)  // the last edge runs from the last corner to the first
    faces.middleCols(corners, corners - 1).rowwise().reverseInPlace();
}

void place(DofSet& set, const Placement& at) {
  const double handed = at.mirrors() ? -1.0 : 1.0;
  for (Eigen::Index k = 0; k < set.position.rows(); ++k) {
    set.position.row(k) = (at.origin + at.frame * set.position.row(k).transpose()).transpose();
    // Rotations are axial vectors.
    const double sign = set.is_rotation[static_cast<size_t>(k)] != 0 ? handed : 1.0;
    set.direction.row(k) = sign * (at.frame * set.direction.row(k).transpose()).transpose();
  }
  set.node_ids.clear();
  set.components.clear();
  if (at.mirrors())
    for (auto& [type, faces] : set.faces) reverse_faces(faces);
}

void place(ContactGrid& grid, const Placement& at) {
  grid.axis_point = at.origin + at.frame * grid.axis_point;
  grid.axis = at.frame * grid.axis;
  grid.zero_angle = at.frame * grid.zero_angle;
}

void place(Skin& skin, const Placement& at) {
  if (skin.nodes.rows() == 0) return;
  skin.nodes = (skin.nodes * at.frame.transpose()).rowwise() + at.origin.transpose();
  for (Eigen::Index a = 0; a < skin.T.rows(); a += 3)
    skin.T.middleRows<3>(a) = (at.frame * skin.T.middleRows<3>(a)).eval();
  if (at.mirrors()) reverse_faces(skin.triangles);
}

/// The unit motions of the assembly, t + w x (origin + frame x), as those of the part.
Eigen::Matrix<double, 6, 6> motions_of_part(const Placement& at) {
  Eigen::Matrix<double, 6, 6> motions = Eigen::Matrix<double, 6, 6>::Zero();
  const Eigen::Matrix3d back = at.frame.transpose();
  motions.topLeftCorner<3, 3>() = back;
  for (int d = 0; d < 3; ++d)
    motions.block<3, 1>(0, 3 + d) = back * Eigen::Vector3d::Unit(d).cross(at.origin);
  motions.bottomRightCorner<3, 3>() = (at.mirrors() ? -1.0 : 1.0) * back;
  return motions;
}

}  // namespace

ReducedModel placed(ReducedModel model, const Placement& at) {
  if (at.mirrors() && !model.grids.empty())
    throw InputError(
        fmt::format("{}: found the contact grid \"{}\" in a mirrored part, expected none: mirror "
                    "its mesh and reduce it again",
                    model.name, model.grids.begin()->first));
  for (auto& [name, set] : model.sets) place(set, at);
  for (auto& [name, grid] : model.grids) place(grid, at);
  place(model.skin, at);
  model.rigid *= motions_of_part(at);
  model.mass.centre = at.origin + at.frame * model.mass.centre;
  model.mass.inertia = at.frame * model.mass.inertia * at.frame.transpose();
  model.inertia = {};
  return model;
}

}  // namespace clatter::rom
