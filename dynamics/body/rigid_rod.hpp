// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The connecting rod: a rigid body in the plane of the crank.
#include "dynamics/body/modal_body.hpp"

namespace clatter::dynamics {

/// Mass and shape of a rod; lengths are measured along the rod.
struct RodProperties {
  double length = 0.0;   // big end to small end [m]
  double mass = 0.0;     // [kg]
  double inertia = 0.0;  // about the centre of mass, x axis [kg m2]
  double centre = 0.0;   // big end to centre of mass [m]
  double offset = 0.0;   // of the centre of mass from the line of the ends, toward +y [m]

  double small_arm() const { return length - centre; }  // centre of mass to small end [m]
  double big_arm() const { return -centre; }            // centre of mass to big end [m]
};

/// Two point masses at the ends with the rod's mass and centre of mass. Their moment of inertia
/// about it, m c (l - c), is that of the result.
RodProperties two_mass_rod(const RodProperties& rod);

/// The rod's three coordinates (y, z of the centre of mass, rotation about x) as deviations from
/// the ideal slider-crank motion. Its mass matrix is constant in these coordinates for any
/// rotation, so it is a body of three rigid modes; the joints contain the geometry.
ModalBody make_rigid_rod(const std::string& name, const RodProperties& rod);

}  // namespace clatter::dynamics
