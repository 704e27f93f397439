// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The reduced models of a scene, read once, with their modal bodies.
#include <deque>
#include <string>

#include "core/rom/reduced_model.hpp"
#include "dynamics/body/modal_body.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// A body of the scene with its reduced model.
struct LoadedBody {
  BodySpec spec;
  std::string sha256;       // of the model's file
  rom::ReducedModel model;  // without its skin
  ModalBody modal;
};

using LoadedBodies = std::deque<LoadedBody>;

/// Reads every body that the scene simulates (a rigid block is not simulated).
LoadedBodies load_bodies(const Scene& scene);
/// The body of that name, or nullptr.
const LoadedBody* find_body(const LoadedBodies& bodies, const std::string& name);

/// The coordinate of a set along (or, for rotations, about) axis 0, 1 or 2.
/// InputError naming the set when it has none.
int set_dof(const rom::ReducedModel& model, const std::string& set, int axis, bool rotation);
/// The vector of a unit load; InputError listing the available names.
const Eigen::VectorXd& unit_load(const rom::ReducedModel& model, const std::string& load);

}  // namespace clatter::dynamics
