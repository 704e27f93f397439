// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The lines that move a part: of *INSTANCE and of *NCOPY, SHIFT.
#include <Eigen/Geometry>

#include "mesh/deck/abaqus/fields.hpp"

namespace clatter::mesh::deck::abaqus {

/// x -> rotation * x + shift.
struct Placement {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();

  /// Line 0: the translation. Line 1: two points of an axis and an angle in degrees, after it.
  void read(const Fields& fields, int line);
  Eigen::Affine3d affine() const;
};

}  // namespace clatter::mesh::deck::abaqus
