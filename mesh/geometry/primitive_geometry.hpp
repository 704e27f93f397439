// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Simple shapes for samples and tests.
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// Lengths in the part's unit.
struct BoxParameters {
  Eigen::Vector3d size = Eigen::Vector3d::Zero(), origin = Eigen::Vector3d::Zero();
  std::string region = "solid";
};
struct CylinderParameters {
  double radius = 0.0, length = 0.0, inner_radius = 0.0;  // 0: solid
  std::string region = "solid";
};
const keys::Keys<BoxParameters>& box_part_keys();
const keys::Keys<CylinderParameters>& cylinder_part_keys();

/// Surfaces x_min, x_max, y_min, ... z_max.
PartGeometry build_box(GmshSession& session, const BoxParameters& p);

/// Axis z from the origin. Surfaces bottom, top, outer, and inner of a hollow one.
PartGeometry build_cylinder(GmshSession& session, const CylinderParameters& p);

}  // namespace clatter::mesh
