// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Coulomb friction that sticks.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "dynamics/law/internal_state.hpp"

namespace clatter::dynamics {

/// Elastic deflection z of a contact in its plane, before a slider with Coulomb's limit (Prandtl's
/// body; elasto-plastic friction, Dupont et al. 2002):
///
///   q = k z + c z',   |q| <= mu N,   z' = slip where |q| is below that limit, so that it sticks.
///
/// It rests without creep, at any load, and what it loses is never negative. A contact that sticks
/// breaks away at the coefficient `at_rest`; one that slides has the kinetic one until it sticks. z
/// is an internal state under the tableau of the step; a stage is solved in closed form: with
/// Q = k z~ + (k kappa + c) slip it sticks by q = Q, or slides by q = mu N Q / |Q|.
class Bristle {
 public:
  /// @param stiffness k > 0 [N/m]. @param damping c [N s/m]. @param kinetic, at_rest coefficients.
  Bristle(double stiffness, double damping, double kinetic, double at_rest)
      : k_(stiffness), c_(damping), kinetic_(kinetic), at_rest_(at_rest) {}

  struct Force {
    Eigen::Vector2d value;      // q, against the slip [N]
    Eigen::Matrix2d by_slip;    // [N s/m]
    Eigen::Vector2d by_normal;  // 1; zero where it sticks
  };
  /// At a stage, of the slip [m/s] in axes of the plane and the normal force N >= 0 [N].
  Force evaluate(const Stage& stage, const Eigen::Vector2d& slip, double normal);
  void finish_stage(const Stage& stage) { z_.finish_stage(stage); }
  void accept_step();

  // At the last evaluation:
  double stored() const { return 0.5 * k_ * z_.value().squaredNorm(); }  // [J]
  /// Of the power q . slip, what is not stored [W].
  double lost(const Eigen::Vector2d& slip) const;

  std::vector<double> save() const;
  /// Takes the 5 numbers of save().
  void restore(std::span<const double> state);

 private:
  double k_, c_, kinetic_, at_rest_;
  InternalState<Eigen::Vector2d> z_{Eigen::Vector2d::Zero()};
  bool slid_ = false, slides_ = false;  // at the end of the last step, and now
};

}  // namespace clatter::dynamics
