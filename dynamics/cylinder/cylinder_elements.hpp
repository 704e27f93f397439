// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The forces between the bodies of a cylinder.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/film/piston_liner.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"

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

/// The bore of an elastic block as a side of elements between piston and liner.
struct LinerSide {
  film::ElasticSurface surface;
  std::vector<int>
      coordinates;  // y indices of its patches, then of the rigid motion that fits them
  LinerFit fit;
  int axial;                 // y index of the coordinate that takes axial forces on it
  Eigen::Vector2d axial_at;  // (x, y) of their line of action [m]
};

// Each function requests the coordinates that its element needs, in the order in which they are to
// be numbered, and returns the element. InputError for sets that a body lacks.

PinNode pin_node(const CylinderBodies& bodies);
std::unique_ptr<ForceElement> pin_guide(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin);
/// Of a cylinder on an elastic block.
LinerSide liner_side(const CylinderBodies& bodies);
/// @param gas the cylinder's pressure, when it has one.
LinerContact liner_contact(const CylinderBodies& bodies, const SliderCrank& crank,
                           const PinNode& pin, const std::optional<Spline>& gas);

}  // namespace clatter::dynamics
