// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The linear part of an implicit stage, per step size.
#include <Eigen/Core>
#include <vector>

#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// For one kappa = a_ii dt. A mode with inertia has the rates (exact_mode.hpp)
///   w = beta v - alpha / omega^2 (a + delta v),   w_v = beta a + alpha v,
///   a = F - delta v - omega^2 eta,
/// which are v and a themselves with alpha = 0, beta = 1, as without `exact`. The stage equations
/// eta = eta~ + kappa w, v = v~ + kappa w_v are solved for a, without cancellation at any kappa:
///   a = g (F - omega^2 eta~ - h v~),  v = (v~ + kappa beta a) / c,   c = 1 - kappa alpha,
///   h = delta + kappa beta omega^2 / c,   g = 1 / (c + kappa beta h),   H = d eta / d F.
/// A quasi-static mode and a state have v = v~ + kappa a, eta = eta~ + kappa v and
/// H = 1 / (delta / kappa + omega^2).
/// Per body S = P H P^T, so that y = y_pred + S f. S is applied by its factors, or as it is
/// where it has been formed and is smaller; it can be formed only in the rows that are asked for: a
/// body of hundreds of rows is touched in some tens of them.
class StageOperator {
 public:
  /// @param diagonal d = kappa / dt of a two-stage method, whose steps then move free modes
  /// exactly; 0: the method as it is.
  StageOperator(const System& system, double kappa, double diagonal = 0.0);

  double kappa() const { return kappa_; }
  const Eigen::VectorXd& H() const { return H_; }
  /// Displacements, velocities and accelerations of the stage under modal forces F; all N.
  void settle(const Eigen::VectorXd& eta_tilde, const Eigen::VectorXd& v_tilde,
              const Eigen::VectorXd& F, StageState& out) const;
  /// The rates of (eta, v) in a state, N each.
  void rates(const StageState& state, Eigen::VectorXd& eta, Eigen::VectorXd& v) const;
  /// The embedded error (e_eta, e_v) filtered by the linear part of the stage equations.
  void filter(const Eigen::VectorXd& e_eta, const Eigen::VectorXd& e_v,
              Eigen::VectorXd& filtered) const;
  /// Share of the diagonal of S that is due to modes with inertia, n_y, 0 to 1: of a change of y by
  /// unbalanced forces this much is motion that has kinetic energy.
  const Eigen::VectorXd& moving_share() const { return moving_share_; }
  /// Writes S of one body in some of its rows (indices in System::rows), n x n.
  void form_S(int body, const std::vector<int>& rows, Eigen::MatrixXd& S) const;
  /// S of one body, in the order of its rows; that of all bodies is formed at the first call.
  Eigen::Map<const Eigen::MatrixXd> S(int body) const;
  /// S f, n_y.
  void apply_S(const Eigen::VectorXd& f, Eigen::VectorXd& result) const;

 private:
  void form_all_S() const;

  const System* system_;
  double kappa_;
  Eigen::VectorXd H_;
  Eigen::VectorXd per_force_;              // g
  Eigen::VectorXd per_velocity_;           // h
  Eigen::VectorXd v_of_v_, v_of_a_;        // v = v_of_v v~ + v_of_a a
  Eigen::VectorXd rate_of_v_, rate_of_a_;  // w = rate_of_v v + rate_of_a a
  Eigen::VectorXd alpha_, beta_;           // of the modes
  Eigen::VectorXd from_eta_, from_v_;      // the filter
  Eigen::VectorXd moving_share_;
  // Mutable: formed when first asked for; working memory, so that no step takes memory.
  mutable std::vector<double> S_;                         // of all bodies; empty: not formed
  mutable std::vector<size_t> S_starts_;                  // per body
  mutable std::vector<Eigen::VectorXd> part_, modal_;     // per body: its rows, its modes or rows
  mutable std::vector<Eigen::MatrixXd> picked_, scaled_;  // per body: rows of P, and times H
};

}  // namespace clatter::dynamics
