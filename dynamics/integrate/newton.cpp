// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/stopwatch.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

constexpr int kMaxIterations = 24;
/// Matrices formed in one stage. A film cell that fills or empties makes the force strongly
/// nonlinear: then each iteration needs its own matrix, and a few of them decide which cells are
/// full.
constexpr int kMaxFresh = 10;
/// Residual and increment below this fraction of the error limit count as converged: the remaining
/// Newton error is then far below the error that the step control measures.
constexpr double kConverged = 0.05;
/// A matrix that contracts slower than this is formed again.
constexpr double kSlow = 0.3;
/// Units in the last place of y below which an increment is rounding: a few operations.
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
/// No earlier increment by the same matrix.
constexpr double kNone = std::numeric_limits<double>::infinity();

}  // namespace

StageNewton::StageNewton(System& system, const ErrorWeights& weights, StepStatistics& statistics)
    : system_(system),
      weights_(weights),
      statistics_(statistics),
      matrix_(system),
      all_(static_cast<size_t>(system.interface_size())) {
  std::iota(all_.begin(), all_.end(), 0);
}

bool StageNewton::factor(const StageOperator& op) {
  const Stopwatch clock;
  const bool regular = matrix_.form(op);
  kappa_ = op.kappa();
  ++statistics_.factorizations;
  statistics_.factor_seconds += clock.seconds();
  return regular;
}

bool StageNewton::is_rounding(const VectorXd& y) const {
  LargestEntry change, size;
  for (size_t i = 0; i < rows_->size(); ++i) {
    const int at = (*rows_)[i];
    const double weight = weights_.displacement(at);
    change.take(std::abs(dy_(static_cast<Eigen::Index>(i))) * weight, at);
    size.take(std::abs(y(at)) * weight, at);
  }
  return change.value <= kRounding * size.value;
}

/// Residual and increment of y in rows_: those that elements touch, which do not depend on the
/// others, where the matrix is of these; else all.
void StageNewton::correct(const StageOperator& op, const VectorXd& y_pred, const VectorXd& y,
                          const VectorXd& f) {
  if (matrix_.covers(op)) {
    rows_ = &matrix_.touched_y();
    matrix_.apply_S(f, residual_);
    for (size_t i = 0; i < rows_->size(); ++i)
      residual_(static_cast<Eigen::Index>(i)) += y_pred((*rows_)[i]) - y((*rows_)[i]);
    dy_ = residual_;
    matrix_.solve_touched(dy_);
    return;
  }
  rows_ = &all_;
  op.apply_S(f, residual_);
  residual_ += y_pred - y;
  dy_ = residual_;
  matrix_.solve(op, dy_);
}

StageNewton::Result StageNewton::solve(const Stage& stage, const StageOperator& op,
                                       const VectorXd& y_pred, const VectorXd& y_tilde, VectorXd& y,
                                       VectorXd& f) {
  Result result{Outcome::kDiverged, "", "", -1};
  if (y.size() == 0) {
    f.resize(0);
    return {Outcome::kConverged, "", "", -1};
  }
  double previous = kNone;
  bool refresh = kappa_ != op.kappa();
  int fresh = 0;
  for (int iteration = 0; iteration < kMaxIterations && fresh + refresh <= kMaxFresh; ++iteration) {
    try {
      const Stopwatch clock;
      ++statistics_.evaluations;
      v_ = (y - y_tilde) / stage.kappa;
      system_.evaluate(stage, y, v_, refresh, f);
      statistics_.element_seconds += clock.seconds();
    } catch (const StepRefused& refusal) {
      forget();
      return {Outcome::kRefused, refusal.kind(), refusal.detail(), -1};
    }
    if (refresh) {
      if (!factor(op)) {
        result.kind = "the equations of a stage are singular or not finite";
        break;
      }
      ++fresh;
      previous = kNone;  // norms by two matrices do not compare
    }
    correct(op, y_pred, y, f);
    const LargestEntry change = weights_.largest_change(dy_, *rows_, op);
    const double size = change.value,
                 imbalance = weights_.largest_change(residual_, *rows_, op).value;
    result.worst = change.at;
    if (!std::isfinite(size + imbalance)) {
      result.kind = "the forces are not finite";
      break;
    }
    const bool slow = size > kSlow * previous;
    // Without a check the matrix of a closed contact would hold the opened one in small steps.
    const bool checked = refresh || (previous < kNone && !slow);
    if (checked && ((size <= kConverged && imbalance <= kConverged) || is_rounding(y))) {
      moved_.setZero(y.size());
      scatter_add(dy_, *rows_, moved_);
      system_.pass_on(moved_, f);
      result.outcome = Outcome::kConverged;
      return result;
    }
    scatter_add(dy_, *rows_, y);
    // Once one matrix failed for two states of this stage, each state gets its own.
    refresh = refresh ? fresh > 1 : slow;
    previous = size;
  }
  forget();
  return result;
}

}  // namespace clatter::dynamics
