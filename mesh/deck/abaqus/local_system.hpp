// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Axes and kind of the coordinates of nodes: *SYSTEM, and SYSTEM= of *NODE and *NGEN.
#include <Eigen/Core>

#include "mesh/deck/abaqus/card.hpp"

namespace clatter::mesh::deck::abaqus {

/// *SYSTEM: coordinates that follow are in these axes.
struct LocalSystem {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  bool is_global() const { return origin.isZero(0.0) && axes.isIdentity(0.0); }
  Eigen::Vector3d global(const Eigen::Vector3d& x) const { return origin + axes * x; }
};

/// Origin a, a point b of the x axis, a point c of the xy plane; no lines: the global axes. Without
/// c x is turned about z. InputError for points on one line.
LocalSystem local_system(const Card& card, const Source& source);

/// The parameter SYSTEM: R (rectangular), C (cylindrical) or S (spherical).
char coordinates_of(const Keyword& keyword, const Source& source);
/// Rectangular coordinates of r, theta, z (C) or r, theta, phi (S), angles in degrees: theta about
/// z, phi above the xy plane.
Eigen::Vector3d cartesian(char kind, const Eigen::Vector3d& x);

}  // namespace clatter::mesh::deck::abaqus
