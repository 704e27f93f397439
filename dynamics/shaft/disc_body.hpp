// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Discs of shafts as bodies.
#include <string>

#include "dynamics/bearing/shaft_axes.hpp"
#include "dynamics/body/modal_body.hpp"

namespace clatter::dynamics {

/// Inertia of a disc or slice about its centre of mass.
struct DiscInertia {
  double mass = 0.0;                    // [kg]
  double polar = 0.0, diametral = 0.0;  // about the axis, across it [kg m2]
};

/// How a disc turns at the start.
struct DiscStart {
  double angle = 0.0, speed = 0.0;  // [rad], [rad/s]
};

/// A disc that moves in space with small tilts: the displacements x, y, z of its centre of mass and
/// the rotations rx, ry, rz [rad], of which the one about the shaft's axis is large. The axes do
/// not turn, so the mass is constant and diagonal: m, m, m, diametral, diametral, polar
/// (Genta 2005, chapter 2). A spinning disc needs its DiscGyroscope.
/// InputError unless mass and moments are positive.
ModalBody make_disc_body(const std::string& name, const DiscInertia& inertia, const ShaftAxes& axes,
                         const DiscStart& start);

/// A disc with the angle about the shaft's axis as its only coordinate. Its mass is only a scale of
/// the error test. InputError unless mass and polar moment are positive.
ModalBody make_turning_body(const std::string& name, const DiscInertia& inertia,
                            const ShaftAxes& axes, const DiscStart& start);

}  // namespace clatter::dynamics
