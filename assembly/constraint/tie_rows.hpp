// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The motion of a point that follows the masters of a tie.
#include <Eigen/Core>
#include <array>
#include <string>

#include "assembly/coupling/coupling.hpp"
#include "assembly/tie/mortar.hpp"

namespace clatter::assembly {

/// Displacement x, y, z of a point, each by DoFs.
using PointMotion = std::array<Functional, 3>;

/// to += factor * of.
void add(double factor, const Functional& of, Functional& to);

/// From the point `row` of the masters to the point itself.
Eigen::Vector3d arm_of(const ProjectedNode& row, const Eigen::Vector3d& at, const RowMatrix& nodes);

/// The part of the motion due to the distance from the combined masters, arm = x_j - sum P_jk x_k:
/// the masters' common rotation times the arm, of the faces around where they lie on a line, as
/// those of congruent faces do. So rigid motions are followed exactly across gaps
/// and on curved faces.
PointMotion rotation_rows(const ProjectedNode& row, const Eigen::Vector3d& arm,
                          const RowMatrix& nodes, const std::string& where);

/// Adds the displacements of the masters.
void add_masters(const ProjectedNode& row, PointMotion& motion);

}  // namespace clatter::assembly
