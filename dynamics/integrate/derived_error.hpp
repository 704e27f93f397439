// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Errors of forces and accelerations, which follow from the motion.
#include <Eigen/Core>
#include <vector>

#include "dynamics/integrate/accuracy.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// What an error of the motion in a step does to the forces of the elements and to the
/// accelerations of the bodies, where limits for them were asked for. Both follow from the
/// elements' last tangents T:
///
///   e_f = T e_y,   e_a = P^T e_f - delta e_v - omega^2 e_eta
class DerivedError {
 public:
  /// `system` outlives the object.
  DerivedError(const System& system, const Accuracy& accuracy);

  /// The largest error over its limit, NaN when one is not finite: of an element's force, the sum
  /// over its translations; of a body's acceleration, the norm over its modes with inertia. 0 where
  /// no limit was asked for. @param e_eta, e_v N. @param e_y n_y.
  double measure(const Eigen::VectorXd& e_eta, const Eigen::VectorXd& e_v,
                 const Eigen::VectorXd& e_y);

 private:
  double force_error(const Eigen::VectorXd& e_y);
  double acceleration_error(const Eigen::VectorXd& e_eta, const Eigen::VectorXd& e_v,
                            const Eigen::VectorXd& e_y);
  const System& system_;
  double force_limit_;                      // [N]; 0: not tested
  std::vector<double> acceleration_limit_;  // per body, of the modal norm; empty: not tested
  Eigen::VectorXd f_, a_;
};

}  // namespace clatter::dynamics
