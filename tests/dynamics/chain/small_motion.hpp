// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small motions of a system about a state of rest.
#include <Eigen/Core>
#include <complex>

#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics::testing {

struct SmallMotion {
  Eigen::VectorXd hertz;   // ascending, without damping; 0 where the stiffness is negative
  Eigen::MatrixXd shapes;  // of y, scaled to a modal mass of 1
};

/// Of rigid bodies in a plane, by the elements' tangents at `y`. Each body's coordinates are its
/// own modes.
SmallMotion small_motion(System& system, const Eigen::VectorXd& y);

/// Free motions y exp(s t) with damping and states.
struct DampedMotion {
  Eigen::VectorXcd s;       // [1/s]
  Eigen::MatrixXcd shapes;  // of y, columns of length 1
};

/// Those whose s is nearest to `shift`, nearest first: inverse iteration of a subspace for
/// s^2 M + s C + K.
DampedMotion damped_motion(System& system, const Eigen::VectorXd& y, std::complex<double> shift,
                           int count);

}  // namespace clatter::dynamics::testing
