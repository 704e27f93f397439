// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The forces between the bodies of a scene and to the ground.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "dynamics/film/piston_liner.hpp"
#include "dynamics/force/element.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/run/scene_bodies.hpp"

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

// Each function requests the coordinates that its element needs, in the order in which they are to
// be numbered, and returns the element. InputError for sets that a body lacks.

PinNode pin_node(const SceneBodies& bodies, System& system);
std::unique_ptr<ForceElement> pin_joint(const SceneBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin, System& system);
std::unique_ptr<ForceElement> crank_joint(const SceneBodies& bodies, const SliderCrank& crank,
                                          System& system);
std::unique_ptr<ForceElement> pin_guide(const SceneBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin, System& system);
LinerContact liner_contact(const SceneBodies& bodies, const SliderCrank& crank, const PinNode& pin,
                           System& system);
/// One per [[mount]], without those of a block that is not simulated. InputError for a body that is
/// not in the scene.
std::vector<std::unique_ptr<ForceElement>> mounts_of(const SceneBodies& bodies, System& system);

}  // namespace clatter::dynamics
