// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Bodies with a reduced model: what a scene says of them, and what was read.
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "dynamics/body/elastic_rod.hpp"
#include "dynamics/body/floating_body.hpp"
#include "dynamics/body/modal_body.hpp"

namespace clatter::dynamics {

/// What the frame of a body with a reduced model does: it rests, or its cylinder moves it; it moves
/// freely in space (floating_body.hpp); a drive turns it (moving_frame.hpp); it is the rod of a
/// slider-crank (elastic_rod.hpp).
enum class BodyMotion { kGiven, kSpace, kDrive, kRod };

/// A body with a reduced model: [piston], [block], [[body]].
struct BodySpec {
  std::string name;
  std::filesystem::path rom;
  bool elastic = true;         // model = "elastic" | "rigid"
  double mode_limit_hz = 0.0;  // inertia of higher modes is dropped; 0: never
  /// Scales of the error test for this body; 0: those of [accuracy].
  double displacement_scale = 0.0, velocity_scale = 0.0;  // [m], [m/s]
  std::string where;                                      // "file:line", for messages

  BodyMotion motion = BodyMotion::kGiven;
  std::string drive;  // that turns the frame
  /// In space, of the centre of mass; its place is that of the model unless given.
  SpatialMotion start;
  bool is_placed = false;
};

/// A node of a reduced model with its DoFs: x, y, z and, if it turns, rx, ry, rz.
struct Node {
  Eigen::Vector3d position;  // in the model's frame [m]
  std::vector<int> dofs;
};

/// A body of the scene with its reduced model.
struct LoadedBody {
  BodySpec spec;
  std::string sha256;       // of the model's file
  rom::ReducedModel model;  // without its skin
  ModalBody modal;
  std::optional<ElasticShapes> shapes;  // of one that moves in space
  std::optional<ElasticRod> rod;        // of one that is a rod
  /// Reduced coordinates q = sampled * (coordinates of the system's body, from first_sampled on).
  /// In space they are those of the deformation, in the body's mean axes; of a rod with its small
  /// motion out of the plane.
  Eigen::MatrixXd sampled;
  int first_sampled = 0;
};

using LoadedBodies = std::deque<LoadedBody>;

/// Makes the modal body of a reduced model. InputError when the model does not allow the motion
/// that the spec says.
LoadedBody make_loaded_body(const BodySpec& spec, rom::ReducedModel model);
/// The same of the model that is read from the spec's file.
LoadedBody load_body(const BodySpec& spec);
/// The body of that name, or nullptr.
const LoadedBody* find_body(const LoadedBodies& bodies, const std::string& name);

/// The coordinates of a set along (or, for rotations, about) axis 0, 1 or 2, one per node.
/// InputError naming the set when it has none.
std::vector<int> set_dofs(const rom::ReducedModel& model, const std::string& set, int axis,
                          bool rotation);
/// The only one. InputError when there are none or several.
int set_dof(const rom::ReducedModel& model, const std::string& set, int axis, bool rotation);
/// The only node of a set. InputError when it lacks a displacement, or has several nodes.
Node node_of(const rom::ReducedModel& model, const std::string& set);
/// The vector of a unit load; InputError listing the available names.
const Eigen::VectorXd& unit_load(const rom::ReducedModel& model, const std::string& load);

}  // namespace clatter::dynamics
