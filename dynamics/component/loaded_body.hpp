// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Bodies with a reduced model: what a scene says of them, and what was read.
#include <deque>
#include <filesystem>
#include <string>

#include "core/rom/reduced_model.hpp"
#include "dynamics/body/modal_body.hpp"

namespace clatter::dynamics {

/// A body with a reduced model: [piston], [block], [[body]].
struct BodySpec {
  std::string name;
  std::filesystem::path rom;
  bool elastic = true;         // model = "elastic" | "rigid"
  double mode_limit_hz = 0.0;  // inertia of higher modes is dropped; 0: never
  /// Scales of the error test for this body; 0: those of [accuracy].
  double displacement_scale = 0.0, velocity_scale = 0.0;  // [m], [m/s]
  std::string where;                                      // "file:line", for messages
};

/// A body of the scene with its reduced model.
struct LoadedBody {
  BodySpec spec;
  std::string sha256;       // of the model's file
  rom::ReducedModel model;  // without its skin
  ModalBody modal;
};

using LoadedBodies = std::deque<LoadedBody>;

/// Reads the reduced model of a body and makes its modal body.
LoadedBody load_body(const BodySpec& spec);
/// The body of that name, or nullptr.
const LoadedBody* find_body(const LoadedBodies& bodies, const std::string& name);

/// The coordinates of a set along (or, for rotations, about) axis 0, 1 or 2, one per node.
/// InputError naming the set when it has none.
std::vector<int> set_dofs(const rom::ReducedModel& model, const std::string& set, int axis,
                          bool rotation);
/// The only one. InputError when there are none or several.
int set_dof(const rom::ReducedModel& model, const std::string& set, int axis, bool rotation);
/// The vector of a unit load; InputError listing the available names.
const Eigen::VectorXd& unit_load(const rom::ReducedModel& model, const std::string& load);

}  // namespace clatter::dynamics
