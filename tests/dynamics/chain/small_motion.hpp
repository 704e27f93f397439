// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small motions of a system of rigid bodies in a plane about a state of rest.
#include <Eigen/Core>

#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics::testing {

struct SmallMotion {
  Eigen::VectorXd hertz;   // ascending, without damping; 0 where the stiffness is negative
  Eigen::MatrixXd shapes;  // of y, scaled to a modal mass of 1
};

/// By the elements' tangents at `y`. Each body's coordinates are its own modes.
SmallMotion small_motion(System& system, const Eigen::VectorXd& y);

}  // namespace clatter::dynamics::testing
