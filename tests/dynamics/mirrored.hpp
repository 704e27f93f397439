// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced models mirrored at the plane y = 0.
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::dynamics::testing {

/// Coordinate k of a model is `sign[k]` times coordinate `place[k]` of the mirrored model.
struct Mirror {
  std::vector<int> place;
  std::vector<double> sign;
};

/// A synthetic model (synthetic.hpp) and its mirror image: displacements along y and rotations
/// about x and z change their signs, patches of a grid change places. Without skin.
rom::ReducedModel mirrored(const rom::ReducedModel& model, Mirror& mirror);

}  // namespace clatter::dynamics::testing
