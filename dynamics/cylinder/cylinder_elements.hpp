// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The forces between the bodies of a cylinder.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/film/piston_liner.hpp"
#include "dynamics/force/joint.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// y indices of the pin's node in the piston: x, y, z, rx, ry, rz.
using PinNode = std::array<int, 6>;

/// y indices of the rigid motion that fits the liner's patches best: y at the crank axis, and the
/// rotation about x.
struct LinerFit {
  int lateral, tilt;
};

/// Piston and liner.
struct LinerContact {
  std::unique_ptr<film::PistonLiner> element;
  std::optional<LinerFit> liner;  // of an elastic block
};

/// Sets the heights of the layer on the liner, which `options` has: from below the skirt's lowest
/// position, where it pushes oil, to above that of the highest ring.
void set_layer_range(const SliderCrank& crank, film::PistonLinerOptions& options);

// Each function requests the coordinates that its element needs, in the order in which they are to
// be numbered, and returns the element. InputError for sets that a body lacks.

PinNode pin_node(const CylinderBodies& bodies);
std::unique_ptr<Joint> pin_joint(const CylinderBodies& bodies, const SliderCrank& crank,
                                 const PinNode& pin);
std::unique_ptr<Joint> crank_joint(const CylinderBodies& bodies, const SliderCrank& crank);
std::unique_ptr<ForceElement> pin_guide(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin);
LinerContact liner_contact(const CylinderBodies& bodies, const SliderCrank& crank,
                           const PinNode& pin);

}  // namespace clatter::dynamics
