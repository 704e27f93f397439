// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/integrate/stage_matrix.hpp"
#include "dynamics/integrate/stage_operator.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

/// Bounds of the change of the pseudo-time step from one iteration to the next.
constexpr double kSlower = 0.3, kFaster = 2.0;
/// It also grows by this much while the residual falls however little: friction, which damps each
/// step, would hold it.
constexpr double kSteady = 1.2;
/// Longest pseudo-time step: inertia has no effect.
constexpr double kLongest = 1e3;

class Search {
 public:
  Search(System& system, double time, const VectorXd& eta, const EquilibriumOptions& options)
      : system_(system), options_(options), time_(time), matrix_(system), tau_(options.first_time) {
    found_.eta = eta;
    unit_.setZero(system.modes());
    length_.setZero(system.modes());
    for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
      const Eigen::MatrixXd& P = system.P(b);
      const double mass = system.bodies()[static_cast<size_t>(b)].mass;
      if (P.rows() == 0) continue;
      for (Eigen::Index k = 0; k < P.cols(); ++k) {
        const Eigen::Index at = system.mode_offset(b) + k;
        unit_(at) = P.col(k).cwiseAbs().maxCoeff();
        length_(at) = system.second_order()(at) * (mass > 0.0 ? 1.0 / std::sqrt(mass) : unit_(at));
      }
    }
  }

  Equilibrium run() {
    double previous = 0.0;
    for (; found_.iterations < options_.most_iterations; ++found_.iterations) {
      if (!evaluate()) {
        if (!step_back()) return found_;
        continue;
      }
      if (found_.residual <= options_.residual) {
        found_.found = true;
        return found_;
      }
      if (previous > 0.0) tau_ = std::min(kLongest, tau_ * growth(previous));
      previous = found_.residual;
      if (!move()) return found_;
    }
    return found_;
  }

 private:
  /// Of the pseudo-time step.
  double growth(double previous) const {
    double factor = std::sqrt(previous / found_.residual);
    if (factor > 1.0 && !limited_) factor *= kSteady;
    return std::clamp(factor, kSlower, kFaster);
  }

  /// To the state before one that is refused, for a shorter step; false: there is none.
  bool step_back() {
    if (found_.refused.empty() || before_.size() == 0) return false;
    found_.eta = before_;
    tau_ *= kSlower;
    return true;
  }

  /// False where a state is refused or not finite.
  bool evaluate() {
    found_.refused.clear();
    try {
      return balance();
    } catch (const StepRefused& refused) {
      found_.refused = std::string(refused.what()) + ", " + refused.detail();
      return false;
    }
  }

  /// Forces at rest and what they leave unbalanced; false where that is not finite.
  bool balance() {
    y_ = system_.interface(found_.eta);
    v_.setZero(y_.size());
    system_.begin_step(time_);
    system_.evaluate({time_, tau_, 1, {}}, y_, v_, true, f_);
    system_.load_force(time_, F_);
    system_.add_interface_force(f_, F_);
    unbalanced_ = F_ - system_.omega_squared().cwiseProduct(found_.eta);
    found_.residual = 0.0;
    for (Eigen::Index k = 0; k < unbalanced_.size(); ++k) {
      if (unit_(k) == 0.0) continue;
      const double force = std::abs(unbalanced_(k)) / unit_(k);
      if (force <= found_.residual) continue;
      found_.residual = force;
      found_.worst = static_cast<int>(k);
    }
    if (std::isfinite(unbalanced_.sum())) return true;
    found_.worst = -1;
    return false;
  }

  /// One linearised step of the pseudo-time.
  bool move() {
    const StageOperator op(system_, tau_);
    if (!matrix_.form(op)) return false;
    change_ = op.H().cwiseProduct(unbalanced_);
    system_.interface(change_, dy_);
    matrix_.solve(op, dy_);
    f_.setZero();
    system_.add_tangent_forces(dy_, f_);
    system_.add_interface_force(f_, unbalanced_);
    change_ = op.H().cwiseProduct(unbalanced_);
    const double longest = change_.cwiseProduct(length_).lpNorm<Eigen::Infinity>();
    limited_ = longest > options_.longest_move;
    if (limited_) change_ *= options_.longest_move / longest;
    before_ = found_.eta;
    found_.eta += change_;
    return true;
  }

  System& system_;
  const EquilibriumOptions& options_;
  double time_;
  StageMatrix matrix_;
  double tau_;
  bool limited_ = false;  // the last move, to longest_move
  Equilibrium found_;
  VectorXd before_;  // eta
  VectorXd unit_;    // of each mode: the largest displacement of a y
  VectorXd length_;  // of each mode: its displacement, of rotations at the radius of gyration
  VectorXd y_, v_, f_, F_, unbalanced_, change_, dy_;
};

}  // namespace

Equilibrium find_equilibrium(System& system, double time, const VectorXd& eta,
                             const EquilibriumOptions& options) {
  system.start_frames(time);
  return Search(system, time, eta, options).run();
}

}  // namespace clatter::dynamics
