// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A grid of patches on a cylinder surface; each patch is one generalised coordinate.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "assembly/coupling/coupling.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// A part of the circle divided into equal strips.
struct Sector {
  double begin = 0.0;  // [rad] from zero_angle, right-handed about the axis
  double end = 0.0;    // [rad], begin < end <= begin + 2 pi
  int strips = 1;
};

/// Where the grid lies.
struct PatchGridSpec {
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();   // [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();        // unit vector
  Eigen::Vector3d zero_angle = Eigen::Vector3d::UnitY();  // unit vector, normal to the axis
  std::vector<Sector> sectors;                            // ascending, not overlapping
  Eigen::VectorXd axial_edges;                            // ascending, from axis_point [m]
};

/// A coupling and the grid that it lies on.
struct PatchCoupling {
  Coupling coupling;  // row i * n_axial + j: strip i, axial row j
  rom::ContactGrid grid;
  Eigen::VectorXi nodes_per_patch;
};

/// Mean radial displacement of each patch, positive away from the axis:
///   q_p = sum_{a in p} w_a e_r(x_a) . u_a / sum_{a in p} w_a,   w_a = int N_a dA.
/// A node belongs to the patch in which it lies (on this grid, the one with the nearest centre);
/// nodes outside all sectors or the axial range belong to none. So patches are disjoint.
/// Motion along or about the axis moves no patch. Patch forces p A_patch of a uniform pressure
/// converge to its consistent nodal forces with the cell size.
/// InputError, beginning with `where`: a patch without area (the mesh too coarse, or an opening in
/// the surface), or a surface that is not a cylinder about this axis.
PatchCoupling contact_patches(const std::string& name, const RowMatrix& coordinates,
                              const SurfaceIntegrals& surface, const PatchGridSpec& spec,
                              const std::string& where);

}  // namespace clatter::assembly
