// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/shifted_pencil.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/threads.hpp"
#include "core/sparse/eigen/block_lanczos.hpp"
#include "core/sparse/eigen/mode_values.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kLooseCondition =
    5e14;                         // condition of K - sigma M: sigma M is at the rounding level of K
constexpr double kCloser = 1e-4;  // next shift over the lowest Ritz value, which is an upper bound
constexpr double kBelow = 1e-2;   // the same when the shift was too small
constexpr double kFar = 1e5;      // ratio of lowest eigenvalue to a shift that is too small
constexpr double kRitzZeroKnown = 1e-12;   // Ritz value over the shift that counts as zero
constexpr double kRitzZeroUnknown = 1e-2;  // the same where zeros may not have converged
constexpr double kLarger = 30.0;           // factor on the shift when factorisation fails
constexpr int kMoves = 8;

}  // namespace

double Wanted::highest(double lowest) const {
  if (limit > 0.0) return std::max(limit, lowest);
  return lowest * std::pow(std::max(count, 1), 2.0 / 3.0);
}

ShiftedPencil::ShiftedPencil(const MatrixPencil& pencil, const FactorOptions& options,
                             const MatrixXd& rigid)
    : pencil_(pencil), options_(options), given_rigid_(rigid) {
  full_problem_.size = problem_.size = pencil.rows();
  full_problem_.team = problem_.team = &pencil.team();
  full_problem_.solve = [this](const double* x, double* y, int count) {
    parallel_pieces(full_problem_.size * count,
                    [&](int64_t begin, int64_t end) { std::copy(x + begin, x + end, y + begin); });
    factor().solve_in_order(y, count);
  };
  full_problem_.mass = [this](const double* x, double* y, int count) {
    mass_->multiply(x, y, count);
  };
  problem_.solve = [this](const double* x, double* y, int count) {
    full_problem_.solve(x, y, count);
    rigid_->remove(y, count);
  };
  problem_.mass = full_problem_.mass;
}

void ShiftedPencil::set_order(const std::vector<int64_t>& order) {
  if (mass_) return;
  order_ = order;
  mass_ = pencil_.mass(order_);
  MatrixXd U = order_.empty() ? given_rigid_ : MatrixXd(given_rigid_(order_, Eigen::all));
  MatrixXd MU = *mass_ * U;
  rigid_ = std::make_unique<KnownMotions>(std::move(U), std::move(MU), pencil_.team());
}

void ShiftedPencil::use(const Factor& given, double sigma) {
  given_ = &given;
  full_problem_.sigma = problem_.sigma = sigma;
  report_ = given.report();
  set_order(given.permutation());
}

void ShiftedPencil::shift_to(double sigma) {
  own_.reset();
  full_problem_.sigma = problem_.sigma = sigma;
  const Factor& made = factor();
  if (factors_ == 1) report_ = made.report();
  set_order(made.permutation());
}

const Factor& ShiftedPencil::factor() {
  if (given_ != nullptr) return *given_;
  if (!own_) {
    FactorOptions options = options_;
    if (!order_.empty()) options.permutation = order_;  // same sparsity pattern
    own_ = pencil_.factor(problem_.sigma, options);
    ++factors_;
  }
  return *own_;
}

const SupernodalFactor& ShiftedPencil::local_factor() {
  return dynamic_cast<const SupernodalFactor&>(factor());
}

const SymmetricProduct& ShiftedPencil::local_mass() const {
  return dynamic_cast<const SymmetricProduct&>(*mass_);
}

bool ShiftedPencil::try_shift(double sigma) {
  try {
    shift_to(sigma);
    return true;
  } catch (const NotPositiveDefinite&) {
    return false;
  }
}

void ShiftedPencil::start_shift(bool known) {
  // The only check is that elimination succeeds: rounding errors are detected by the modes'
  // residuals and by the count.
  rigid_complete_ = known;
  if (known && given_rigid_.cols() == 0 && try_shift(0.0)) return;
  least_ = pencil_.bounds().smallest_shift();
  moves_left_ = kMoves;
  shift_from(std::max(-pencil_.default_shift(), least_));
  first_ = sigma();
}

bool ShiftedPencil::return_to_first() {
  if (given_ != nullptr || !(first_ < 0.0) || sigma() == first_) return false;
  moves_left_ = 0;
  shift_to(first_);
  return true;
}

void ShiftedPencil::shift_from(double size) {
  const FactorOptions strict = options_;
  options_.min_rcond = 0.0;
  options_.max_condition = kLooseCondition;
  while (!try_shift(-size)) {
    if (moves_left_-- <= 0) {
      options_ = strict;
      shift_to(-size);  // throws the final error
    }
    size *= kLarger;
  }
}

bool ShiftedPencil::follow(const Eigen::VectorXd& ritz, const Wanted& wanted) {
  if (moves_left_ <= 0) return false;
  const double size = -sigma();
  double lowest = 0.0;  // above possible zeros
  for (const double value : ritz)
    if (value > (rigid_complete_ ? kRitzZeroKnown : kRitzZeroUnknown) * size) {
      lowest = value;
      break;
    }
  double next = size;
  if (lowest > 0.0 && wanted.highest(lowest) < size) next = kCloser * lowest;
  if (lowest > kFar * size) next = kBelow * lowest;
  next = std::max(next, least_);
  if (next > 0.3 * size && next < 3.0 * size) {
    moves_left_ = 0;
    return false;
  }
  --moves_left_;
  shift_from(next);
  return true;
}

void ShiftedPencil::find_shift(const Wanted& wanted, uint64_t seed) {
  while (moves_left_ > 0) {
    const Eigen::VectorXd ritz = first_ritz_values(problem_, seed);
    solves_ += ritz.size();
    if (!follow(ritz, wanted)) return;
  }
}

}  // namespace clatter::sparse
