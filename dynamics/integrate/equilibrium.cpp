// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/integrate/stage_matrix.hpp"
#include "dynamics/integrate/stage_operator.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

/// Bounds of the change of the pseudo-time step from one iteration to the next.
constexpr double kSlower = 0.3, kFaster = 2.0;
/// The pseudo-time step grows by so much while the residual stays: slow states go on.
constexpr double kGrowth = 1.1;
/// Cosine of unbalanced forces before and after a move below which they have changed their sign.
constexpr double kReversed = -0.5;
/// Least part of a move, and by how much it grows again.
constexpr double kLeastPart = 1.0 / 64.0, kRecovery = 1.5;
/// Moves that do not raise the residual by more than kRise may become longer, each time by kLonger.
constexpr double kRise = 1.2, kLonger = 1.5, kMostLonger = 10.0;
/// Halvings of an iteration whose end an element refuses.
constexpr int kMostHalvings = 20;
/// Longest pseudo-time step: inertia has no effect.
constexpr double kLongest = 1e3;

class Search {
 public:
  Search(System& system, double time, const VectorXd& eta, const EquilibriumOptions& options)
      : system_(system),
        options_(options),
        time_(time),
        matrix_(system),
        tau_(options.first_time),
        longest_(options.longest_move) {
    found_.eta = eta;
    unit_.setZero(system.modes());
    reach_.setZero(system.modes());
    for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
      const ModalBody& body = system.bodies()[b];
      const Eigen::MatrixXd& P = system.P(b);
      for (int k = 0; k < body.modes(); ++k) {
        double& unit = unit_(system.mode_offset(b) + k);
        if (body.is_state(k))
          unit = options.rate / options.residual * body.damping(k) * body.state_scale(k);
        else if (P.rows() > 0)
          unit = P.col(k).cwiseAbs().maxCoeff();
        double& reach = reach_(system.mode_offset(b) + k);
        for (Eigen::Index i = 0; !body.is_state(k) && i < P.rows(); ++i) {
          const bool turns = system.is_rotation(system.rows(b)[i]);
          reach = std::max(reach, std::abs(P(i, k)) * (turns ? options.arm : 1.0));
        }
      }
    }
  }

  Equilibrium run() {
    for (; found_.iterations < options_.most_iterations; ++found_.iterations) {
      if (!evaluate_or_retreat()) return found_;
      if (found_.residual <= options_.residual) {
        found_.found = true;
        return found_;
      }
      if (found_.iterations > 0) adapt();
      before_last_ = std::exchange(last_, found_.residual);
      left_before_ = left_;
      if (!move()) return found_;
    }
    return found_;
  }

 private:
  /// Part and length of the next move, and its pseudo-time, by what the last one did.
  void adapt() {
    // Forces that change their sign again and again are jumped over and back, as at the kink of a
    // check valve's law: parts of moves end between.
    const double cosine = left_.dot(left_before_) / (left_.norm() * left_before_.norm());
    const bool reversed =
        cosine < kReversed && found_.residual > 0.5 * std::min(last_, before_last_);
    part_ = reversed ? std::max(kLeastPart, 0.5 * part_) : std::min(1.0, kRecovery * part_);
    if (shortened_ < 1.0 && found_.residual < kRise * last_)
      longest_ = std::min(kMostLonger * options_.longest_move, kLonger * longest_);
    if (found_.residual > 2.0 * last_) longest_ = std::max(options_.longest_move, 0.5 * longest_);
    if (part_ == 1.0) grow();
  }

  /// A move that had to be shortened was of a too long pseudo-time: moves grow with its square.
  void grow() {
    const double factor =
        shortened_ < 1.0 ? std::sqrt(shortened_) : kGrowth * std::sqrt(last_ / found_.residual);
    tau_ = std::min(kLongest, tau_ * std::clamp(factor, kSlower, kFaster));
  }

  /// Goes half of the way back, up to the first state, from states that an element refuses.
  bool evaluate_or_retreat() {
    for (int halvings = 0;; ++halvings) {
      try {
        return evaluate();
      } catch (const StepRefused& refusal) {
        if (found_.iterations == 0 || halvings == kMostHalvings) {
          found_.worst = -1;
          found_.refused = refusal.kind() + ", " + refusal.detail();
          return false;
        }
        change_ *= 0.5;
        found_.eta -= change_;
        tau_ = std::max(options_.first_time, kSlower * tau_);
      }
    }
  }

  /// Forces at rest and what they leave unbalanced.
  bool evaluate() {
    y_ = system_.interface(found_.eta);
    v_.setZero(y_.size());
    system_.begin_step(time_);
    system_.evaluate({time_, tau_, 1, {}}, y_, v_, true, f_);
    system_.load_force(time_, F_);
    system_.add_interface_force(f_, F_);
    unbalanced_ = F_ - system_.omega_squared().cwiseProduct(found_.eta);
    left_.setZero(unbalanced_.size());
    for (Eigen::Index k = 0; k < left_.size(); ++k)
      if (unit_(k) > 0.0) left_(k) = unbalanced_(k) / unit_(k);
    found_.unbalanced = left_.cwiseAbs();
    found_.residual = found_.unbalanced.maxCoeff(&found_.worst);
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
    const double longest = change_.cwiseProduct(reach_).lpNorm<Eigen::Infinity>();
    shortened_ = longest > longest_ ? longest_ / longest : 1.0;
    change_ *= part_ * shortened_;
    found_.eta += change_;
    return true;
  }

  System& system_;
  const EquilibriumOptions& options_;
  double time_;
  StageMatrix matrix_;
  double tau_, longest_;                   // of the next move
  double part_ = 1.0, shortened_ = 1.0;    // of the last move: by relaxation, by its length
  double last_ = 0.0, before_last_ = 0.0;  // residuals before the last two moves
  Equilibrium found_;
  VectorXd reach_;  // of each mode: the largest displacement, of a y or by a rotation; of states 0
  VectorXd unit_;   // of each mode: the largest displacement of a y; of a state in the same measure
  VectorXd left_, left_before_;  // unbalanced forces in the measure of the residual
  VectorXd y_, v_, f_, F_, unbalanced_, change_, dy_;
};

}  // namespace

Equilibrium find_equilibrium(System& system, double time, const VectorXd& eta,
                             const EquilibriumOptions& options) {
  system.start_frames(time);
  return Search(system, time, eta, options).run();
}

}  // namespace clatter::dynamics
