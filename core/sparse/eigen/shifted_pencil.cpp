// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/shifted_pencil.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/log.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/eigen/block_lanczos.hpp"
#include "core/sparse/eigen/mode_values.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kRounding = 2e-15;  // |sigma| over the highest eigenvalue: rounding level of K
constexpr double kCloser = 1e-4;  // next shift over the lowest Ritz value, which is an upper bound
constexpr double kBelow = 1e-2;   // the same when the shift was too small
constexpr double kFar = 1e5;      // ratio of lowest eigenvalue to a shift that is too small
constexpr double kRitzZeroKnown = 1e-12;   // Ritz value over the shift that counts as zero
constexpr double kRitzZeroUnknown = 1e-2;  // the same where zeros may not have converged
constexpr double kLarger = 30.0;           // factor on the shift when factorisation fails
constexpr int kMoves = 8;

}  // namespace

double PencilBounds::smallest_shift() const { return kRounding * top; }

double Wanted::highest(double lowest) const {
  if (limit > 0.0) return std::max(limit, lowest);
  return lowest * std::pow(std::max(count, 1), 2.0 / 3.0);
}

PencilBounds bounds_of(const SparseMatrix& K, const SparseMatrix& M) {
  PencilBounds out;
  for (int j = 0; j < K.cols(); ++j) {
    const double m = M.coeff(j, j);
    if (m > 0.0)
      out.top = std::max(out.top, K.coeff(j, j) / m);
    else
      ++out.massless;
  }
  return out;
}

ShiftedPencil::ShiftedPencil(const SparseMatrix& K, const SparseMatrix& M,
                             const FactorOptions& options, const MatrixXd& rigid)
    : K_(K), M_(M), options_(options), given_rigid_(rigid) {
  full_problem_.size = problem_.size = K.cols();
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
  if (!order_.empty()) return;
  order_ = order;
  const SparseMatrix mass = reordered(M_, order_);
  mass_ = std::make_unique<SymmetricProduct>(mass);
  MatrixXd U = given_rigid_(order_, Eigen::all);
  MatrixXd MU = *mass_ * U;
  rigid_ = std::make_unique<KnownMotions>(std::move(U), std::move(MU));
}

void ShiftedPencil::use(const SupernodalFactor& given, double sigma) {
  given_ = &given;
  full_problem_.sigma = problem_.sigma = sigma;
  report_ = given.report();
  set_order(given.permutation());
}

void ShiftedPencil::shift_to(double sigma) {
  own_.reset();
  full_problem_.sigma = problem_.sigma = sigma;
  const SupernodalFactor& made = factor();
  if (factors_ == 1) report_ = made.report();
  set_order(made.permutation());
}

const SupernodalFactor& ShiftedPencil::factor() {
  if (given_ != nullptr) return *given_;
  if (!own_) {
    const SparseMatrix shifted = K_ - problem_.sigma * M_;
    FactorOptions options = options_;
    if (!order_.empty()) options.permutation = order_;  // same sparsity pattern
    own_ = std::make_unique<SupernodalFactor>(shifted, options);
    ++factors_;
  }
  return *own_;
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
  least_ = bounds_of(K_, M_).smallest_shift();
  moves_left_ = kMoves;
  shift_from(std::max(-default_shift(K_, M_), least_));
}

void ShiftedPencil::shift_from(double size) {
  const FactorOptions strict = options_;
  options_.min_rcond = 0.0;
  options_.max_condition = 1.0 / kRounding;
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
  say(fmt::format("shift: {:.4g} Hz is far from the first mode, about {:.4g} Hz or below",
                  hz_of_value(size), hz_of_value(lowest)));
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
