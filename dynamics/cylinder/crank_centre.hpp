// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The crank's centre as a point of the block.
#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/cylinder/cylinder_bodies.hpp"

namespace clatter::dynamics {

/// The crank's centre in the cylinder's plane, on an elastic block: a force on it is carried by the
/// bearings, and what they lack of its moment (one bearing, bearings off the crank's axis) by the
/// block's rigid frame; all of it where the scene names no bearings. InputError for sets without
/// displacements y and z.
PointWeights crank_centre(const CylinderBodies& bodies);

}  // namespace clatter::dynamics
