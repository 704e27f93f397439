// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Error limits from one tolerance.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// The local error of a step may reach `tolerance` times these scales. The defaults are those of a
/// piston in its bore: 10 um of clearance, crossed with 0.1 m/s, on an arm of 50 mm.
struct Accuracy {
  double tolerance = 1e-3;
  double displacement_scale = 1e-5;  // of every interface coordinate, so of every gap [m]
  double velocity_scale = 0.1;       // of every body as a rigid body [m/s]
  double arm = 0.05;                 // converts rotations to displacements [m]
  /// Of every element's force [N] and every body's acceleration [m/s2]; 0: not tested.
  double force_scale = 0.0, acceleration_scale = 0.0;
};

/// The largest absolute entry of a vector and its index.
struct LargestEntry {
  double value = 0.0;
  int at = -1;

  /// Keeps the larger one; true for a NaN, which is the largest of all: comparisons and std::max
  /// would lose it (hard case N2).
  bool take(double other, int position) {
    if (other <= value) return false;
    *this = {other, position};
    return std::isnan(other);
  }
};

template <typename Vector>
LargestEntry largest_entry(const Vector& x) {
  LargestEntry largest;
  for (int i = 0; i < static_cast<int>(x.size()); ++i)
    if (largest.take(std::abs(x(i)), i)) break;
  return largest;
}

/// Weights of errors: entry times error is 1 at the limit.
///
/// Displacements are checked coordinate by coordinate. Velocities are checked body by body, by the
/// kinetic energy of the error relative to that of the body at its velocity scale: so a patch of
/// some grams that a filling film cell pushes does not limit the step of the entire engine, nor
/// does the lightest body tighten the limit of the others. Quasi-static modes have no kinetic
/// energy: only their displacements are checked (hard case N3). States are checked one by one.
struct ErrorWeights {
  Eigen::VectorXd displacement;  // per y
  Eigen::VectorXd velocity;      // per y: of the smallest modal velocity that moves it so fast
  Eigen::VectorXd modal_displacement, modal_velocity;  // per modal coordinate
  std::vector<double> velocity_limit;  // per body: of |e_v|, the square root of twice an energy

  /// Of all bodies at their limits of velocity [J].
  double least_energy() const {
    double sum = 0.0;
    for (const double limit : velocity_limit) sum += 0.5 * limit * limit;
    return sum;
  }

  /// Largest change of y in a stage over its limits: as a displacement and, over kappa, as a
  /// velocity of the modes with inertia. `dy`: of the y in `rows`; `at` is a y.
  LargestEntry largest_change(const Eigen::VectorXd& dy, const std::vector<int>& rows,
                              const StageOperator& op) const {
    LargestEntry largest;
    for (size_t i = 0; i < rows.size(); ++i) {
      const int y = rows[i];
      const double limit =
          std::max(displacement(y), velocity(y) * op.moving_share()(y) / op.kappa());
      if (largest.take(std::abs(dy(static_cast<Eigen::Index>(i))) * limit, y)) break;
    }
    return largest;
  }
};

ErrorWeights error_weights(const System& system, const Accuracy& accuracy);

/// The largest error of a body over its limit, in |e_eta| and |e_v|; NaN when one is not finite.
double modal_error(const System& system, const ErrorWeights& weights, const Eigen::VectorXd& e_eta,
                   const Eigen::VectorXd& e_v);

}  // namespace clatter::dynamics
