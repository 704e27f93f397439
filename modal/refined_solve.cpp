// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/refined_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/fe/free_motions.hpp"

namespace clatter::modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxSteps = 10;
constexpr double kEps = std::numeric_limits<double>::epsilon();

/// b - A x in extended precision (64-bit mantissa).
VectorXd extended_residual(const SparseMatrix& lower, const VectorXd& x, const VectorXd& b) {
  std::vector<long double> sum(b.begin(), b.end());
  for (int j = 0; j < lower.outerSize(); ++j) {
    const long double xj = x[j];
    long double own = 0.0L;
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      const long double a = it.value();
      sum[it.row()] -= a * xj;
      if (it.row() != j) own += a * static_cast<long double>(x[it.row()]);
    }
    sum[j] -= own;
  }
  VectorXd r(b.size());
  for (Index i = 0; i < r.size(); ++i) r[i] = static_cast<double>(sum[i]);
  return r;
}

double largest_ratio(const VectorXd& part, const VectorXd& whole) {
  double most = 0.0;
  for (Index i = 0; i < part.size(); ++i) {
    const double size = std::abs(part[i]);
    // Written so that NaN propagates.
    if (!(size <= most * whole[i])) most = size == 0.0 ? most : size / whole[i];
  }
  return most;
}

/// |A| |x| + |b|, and where that is rounding beside the row of A times the largest x, that: a row
/// between DoFs that hardly move has nothing to be compared with (Arioli, Demmel and Duff 1989).
/// @param rows sums of |A|. @param most largest |x|.
VectorXd whole_rows(const VectorXd& size, const VectorXd& rows, const VectorXd& b, double most) {
  const double rounding = 1000.0 * static_cast<double>(size.size()) * kEps;
  VectorXd out = size;
  for (Index i = 0; i < size.size(); ++i)
    if (size[i] <= rounding * (rows[i] * most + std::abs(b[i]))) out[i] += rows[i] * most;
  return out;
}

/// Lower bound, mostly sharp, of max_i (|A^{-1}| w)_i = |diag(w) A^{-1}|_1, w >= 0.
double inverse_times(const sparse::SupernodalFactor& factor, const VectorXd& w) {
  const Index n = w.size();
  VectorXd x = VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  double estimate = 0.0;
  for (int step = 0; step < 5; ++step) {
    const VectorXd y = w.cwiseProduct(VectorXd(factor.solve(x)));
    const double size = y.lpNorm<1>();
    if (!(size > estimate)) break;
    estimate = size;
    const VectorXd sign = y.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
    const VectorXd z = factor.solve(w.cwiseProduct(sign));
    Index best = 0;
    const double most = z.cwiseAbs().maxCoeff(&best);
    if (!(most > std::abs(z.dot(x)))) break;
    x.setZero();
    x[best] = 1.0;
  }
  return estimate;
}

void refine(const sparse::SupernodalFactor& factor, const SparseMatrix& lower, const VectorXd& b,
            Eigen::Ref<VectorXd> x, int& steps) {
  double last = std::numeric_limits<double>::infinity();
  for (int step = 1; step <= kMaxSteps; ++step) {
    const VectorXd change = factor.solve(extended_residual(lower, x, b));
    const double size = change.lpNorm<Eigen::Infinity>();
    if (!(size < 0.5 * last)) return;  // no further convergence, and this step may do harm
    x += change;
    steps = std::max(steps, step);
    last = size;
    if (size <= kEps * x.lpNorm<Eigen::Infinity>()) return;
  }
}

}  // namespace

RefinedSolution solve_refined(const sparse::SupernodalFactor& factor, const SparseMatrix& lower,
                              const MatrixXd& b) {
  RefinedSolution out;
  out.x = factor.solve(b);
  out.backward.resize(b.cols());
  out.forward.resize(b.cols());
  const VectorXd rows = magnitude_product(lower, VectorXd::Ones(b.rows()));
  for (Index c = 0; c < b.cols(); ++c) {
    refine(factor, lower, b.col(c), out.x.col(c), out.steps);
    const VectorXd x = out.x.col(c);
    const VectorXd size = VectorXd(magnitude_product(lower, x)) + b.col(c).cwiseAbs();
    const VectorXd rest = extended_residual(lower, x, b.col(c));
    const double most = x.lpNorm<Eigen::Infinity>();
    out.backward[c] = largest_ratio(rest, whole_rows(size, rows, b.col(c), most));
    out.forward[c] = most > 0.0 ? inverse_times(factor, rest.cwiseAbs() + kEps * size) / most : 0.0;
  }
  return out;
}

}  // namespace clatter::modal
