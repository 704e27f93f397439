// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a scene says of a connecting rod.
#include <string>

#include "dynamics/component/loaded_body.hpp"

namespace clatter::dynamics {

/// Models of the rod: a rigid body, two point masses at its ends, a bar without mass, a reduced
/// elastic body.
enum class RodModel { kRigid, kTwoMass, kMassless, kElastic };

/// [rod].
struct RodSpec {
  RodModel model = RodModel::kRigid;
  double given_inertia = 0.0;  // inertia_kg_m2 beside model = "two-mass"; 0: not given [kg m2]
  BodySpec body;               // of an elastic rod
  std::string big_end = "big_end", small_end = "small_end";  // sets of its nodes
  std::string length_where;                                  // "file:line: rod.length_mm"
};

}  // namespace clatter::dynamics
