// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A reduced part in the axes of the assembly that it stands in.
#include <Eigen/Core>

#include "core/rom/reduced_model.hpp"

namespace clatter::rom {

/// Points x of the part are at origin + frame x. A frame of determinant -1 mirrors the part.
struct Placement {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();     // [m]
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  // orthogonal

  bool mirrors() const { return frame.determinant() < 0.0; }
};

/// The same coordinates and matrices; positions, directions, rigid motions, mass properties and
/// recovery in the axes of the assembly. Without inertia invariants, numbers and axes of the deck's
/// nodes. InputError for a mirrored part with contact grids, whose angles would run backwards.
ReducedModel placed(ReducedModel model, const Placement& at);

}  // namespace clatter::rom
