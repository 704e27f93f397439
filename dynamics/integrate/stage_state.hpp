// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One instant of the motion, and the motion between two of them.
#include <Eigen/Core>

namespace clatter::dynamics {

/// One instant of the motion.
struct StageState {
  double time = 0.0;
  Eigen::VectorXd eta, v, a;  // N modal displacements, velocities, accelerations
  Eigen::VectorXd y, v_y;     // n_y interface displacements and velocities
};

/// The cubic with values x0, x1 and derivatives d0, d1 at the ends of an interval of length h, at
/// the fraction t of it.
template <class T>
T hermite(const T& x0, const T& d0, const T& x1, const T& d1, double h, double t) {
  const double u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * x0 + t * t * (3.0 - 2.0 * t) * x1 + h * t * u * u * d0 -
         h * t * t * u * d1;
}

/// Derivative of the same cubic.
template <class T>
T hermite_rate(const T& x0, const T& d0, const T& x1, const T& d1, double h, double t) {
  const double u = 1.0 - t;
  return 6.0 * t * u / h * (x1 - x0) + u * (u - 2.0 * t) * d0 + t * (t - 2.0 * u) * d1;
}

}  // namespace clatter::dynamics
