// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Supports as held coordinates, at which a model's reactions act.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "assembly/coupling/coupling.hpp"
#include "assembly/coupling/dof_numbers.hpp"
#include "assembly/recipe/recipe.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// One held displacement or rotation.
struct HeldDof {
  int support = 0;  // index into Recipe::supports
  NodeOrPoint owner;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  bool is_rotation = false;
  std::string label;  // "foot.17.x": support, node or point, direction of its system
};

/// Held directions of one node or point, displacements or rotations; along the axes when each is
/// one DoF by itself.
struct HeldGroup {
  bool along_axes = true;
  std::vector<HeldDof> held;  // independent directions
};

/// The DoFs that the supports hold. A direction that another support already holds at the same node
/// or point is skipped.
std::vector<HeldGroup> plan_supports(const Recipe& recipe, const mesh::Mesh& mesh,
                                     const DofNumbers& numbers);

/// The nodes or the point of a selection.
std::vector<NodeOrPoint> selected(const recipe::Selection& selection, const mesh::Mesh& mesh,
                                  const DofNumbers& numbers);

/// The displacement along (rotation about) the direction, in terms of DoF ids.
Functional held_functional(const HeldDof& held, const DofNumbers& numbers);

}  // namespace clatter::assembly
