// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Local errors without what rounding makes.
#include <Eigen/Core>
#include <limits>

#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// Rounding of a sum in a step, relative to its terms.
constexpr double kRoundingNoise = 16.0 * std::numeric_limits<double>::epsilon();

/// The error estimate of a step is a difference of sums: an entry below the rounding of its terms
/// is no error, however small the limit (hard case S10).
class RoundingFloor {
 public:
  explicit RoundingFloor(const System& system);

  /// Keeps of the local errors e_eta, e_v (N) and e_y (n_y) of the step from `begin` to `end` the
  /// entries above rounding; the others become 0. Takes no memory.
  void apply(const StageState& begin, const StageState& end, const Eigen::VectorXd& e_eta,
             const Eigen::VectorXd& e_v, const Eigen::VectorXd& e_y);

  /// What the last call kept.
  const Eigen::VectorXd& eta() const { return eta_; }
  const Eigen::VectorXd& v() const { return v_; }
  const Eigen::VectorXd& y() const { return y_; }

 private:
  Eigen::VectorXd eta_, v_, y_;
};

}  // namespace clatter::dynamics
