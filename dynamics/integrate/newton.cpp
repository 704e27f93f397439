// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/stopwatch.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

constexpr int kMaxIterations = 24;
/// Matrices formed in one stage. A film cell that fills or empties makes the force strongly
/// nonlinear: then each iteration needs its own matrix, and a few of them decide which cells are
/// full.
constexpr int kMaxFresh = 10;
/// Increments below this fraction of the error limit count as converged: the remaining Newton error
/// is then far below the error that the step control measures.
constexpr double kConverged = 0.05;
/// A matrix that contracts slower than this is formed again.
constexpr double kSlow = 0.3;

}  // namespace

StageNewton::StageNewton(System& system, const ErrorWeights& weights, StepStatistics& statistics)
    : system_(system), weights_(weights), statistics_(statistics), matrix_(system) {}

bool StageNewton::factor(const StageOperator& op) {
  const Stopwatch clock;
  const bool regular = matrix_.form(op);
  kappa_ = op.kappa();
  ++statistics_.factorizations;
  statistics_.factor_seconds += clock.seconds();
  return regular;
}

double StageNewton::norm(const VectorXd& dy, double kappa, int& worst) const {
  double largest = 0.0;
  for (int i = 0; i < static_cast<int>(dy.size()); ++i) {
    const double weight = std::max(weights_.displacement(i), weights_.velocity(i) / kappa);
    const double value = std::abs(dy(i)) * weight;
    if (!(value <= largest)) {
      largest = value;
      worst = i;
    }
  }
  return largest;
}

StageNewton::Result StageNewton::solve(const Stage& stage, const StageOperator& op,
                                       const VectorXd& y_pred, const VectorXd& y_tilde, VectorXd& y,
                                       VectorXd& f) {
  Result result{Outcome::kDiverged, "", -1};
  if (y.size() == 0) {
    f.resize(0);
    return {Outcome::kConverged, "", -1};
  }
  double previous = std::numeric_limits<double>::infinity();
  bool refresh = kappa_ != op.kappa();
  int fresh = 0;
  for (int iteration = 0; iteration < kMaxIterations && fresh + refresh <= kMaxFresh; ++iteration) {
    try {
      const Stopwatch clock;
      ++statistics_.evaluations;
      const VectorXd v = (y - y_tilde) / stage.kappa;
      system_.evaluate(stage, y, v, refresh, f);
      statistics_.element_seconds += clock.seconds();
    } catch (const StepRefused& refusal) {
      forget();
      return {Outcome::kRefused, refusal.what(), -1};
    }
    if (refresh) {
      if (!factor(op)) break;
      ++fresh;
      previous = std::numeric_limits<double>::infinity();  // norms by two matrices do not compare
    }
    VectorXd dy;
    op.apply_S(f, dy);
    dy += y_pred - y;
    matrix_.solve(dy);
    const double size = norm(dy, stage.kappa, result.worst);
    if (!std::isfinite(size)) break;
    y += dy;
    if (size < kConverged) {
      system_.add_tangent_forces(dy, f);
      result.outcome = Outcome::kConverged;
      return result;
    }
    // Once one matrix failed for two states of this stage, each state gets its own.
    refresh = refresh ? fresh > 1 : size > kSlow * previous;
    previous = size;
  }
  forget();
  return result;
}

}  // namespace clatter::dynamics
