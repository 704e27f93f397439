// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The linear part of an implicit stage, per step size.
#include <Eigen/Core>
#include <vector>

#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// For one kappa = a_ii dt: per mode, with mu = 1 (0 for a quasi-static mode),
///   H = 1 / (mu / kappa^2 + delta / kappa + omega^2)
///   a = H / kappa^2 (F - omega^2 eta~ - (delta + kappa omega^2) v~),  v = v~ + kappa a,
///   eta = eta~ + kappa v,
/// which is the stage equation solved for a: without cancellation at any kappa.
/// Per body S = P H P^T, so that y = y_pred + S f. S is applied by its factors, or as it is
/// where it has been formed and is smaller; it can be formed only in the rows that are asked for: a
/// body of hundreds of rows is touched in some tens of them.
class StageOperator {
 public:
  StageOperator(const System& system, double kappa);

  double kappa() const { return kappa_; }
  const Eigen::VectorXd& H() const { return H_; }
  /// The accelerations a of the stage under modal forces F; all N.
  void acceleration(const Eigen::VectorXd& eta_tilde, const Eigen::VectorXd& v_tilde,
                    const Eigen::VectorXd& F, Eigen::VectorXd& a) const;
  /// The embedded error (e_eta, e_v) filtered by the linear part of the stage equations:
  /// H (mu e_v / kappa + (mu / kappa^2 + delta / kappa) e_eta).
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
  Eigen::VectorXd per_force_;     // H / kappa^2
  Eigen::VectorXd per_velocity_;  // delta + kappa omega^2
  Eigen::VectorXd from_eta_;      // H (mu / kappa^2 + delta / kappa)
  Eigen::VectorXd from_v_;        // H mu / kappa
  Eigen::VectorXd moving_share_;
  mutable std::vector<double> S_;                         // of all bodies; empty: not formed
  mutable std::vector<size_t> S_starts_;                  // per body
  mutable std::vector<Eigen::VectorXd> part_, modal_;     // per body: its rows, its modes or rows
  mutable std::vector<Eigen::MatrixXd> picked_, scaled_;  // per body: rows of P, and times H
};

}  // namespace clatter::dynamics
