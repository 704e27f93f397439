// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/dense_solver.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/dense/cholesky.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::sparse {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSpread = 1e8;    // range of lambda - sigma that one shift resolves
constexpr double kClose = 0.1;     // of the lowest value: distance of a shift below it
constexpr double kTooFar = 100.0;  // largest ratio of shift to lowest value
constexpr double kZero = 1e-10;    // of the shift
constexpr int kShifts = 12;
constexpr double kLargerShift = 30.0;  // factor on a shift at the rounding level of K
constexpr double kFirstShift = 1e-12;  // of the largest K_jj / M_jj, where no other is known
constexpr double kLastShift = 1e3;     // the same, where all of K may be rounding

/// All pairs with nu > 0 except the rigid-body modes.
EigenResult solve_shifted(const MatrixXd& K, const MatrixXd& M, const MatrixXd& rigid,
                          double sigma) {
  EigenResult result;
  const MatrixXd shifted = K - sigma * M;
  const dense::Cholesky factor(shifted);
  if (!factor.ok()) {
    result.status = EigenStatus::kBadInput;
    result.message = "K - sigma M is not positive definite";
    return result;
  }
  const MatrixXd half = factor.solve_lower(M);
  MatrixXd C = factor.solve_lower(half.transpose());
  C = (0.5 * (C + C.transpose())).eval();
  if (rigid.cols() > 0) {  // in z = L^T x: C <- (1 - Z Z^T) C (1 - Z Z^T)
    const MatrixXd image = factor.lower().transpose() * rigid;
    const dense::Cholesky lengths(image.transpose() * image);
    const MatrixXd Z = lengths.solve_lower(image.transpose()).transpose();
    C -= Z * (Z.transpose() * C);
    C -= (C * Z) * Z.transpose();
    C = (0.5 * (C + C.transpose())).eval();
  }
  const dense::Eigenpairs solver = dense::symmetric_eigen(C);
  if (!solver.ok) {
    result.message = "the dense eigen-solver did not converge";
    return result;
  }
  // Ascending nu; the largest are the lowest modes. Massless directions have nu = 0 and are no
  // modes.
  const VectorXd& nu = solver.values;
  const double zero = 1e-14 * nu.cwiseAbs().maxCoeff();
  // What is left of rigid motions is rounding, which may be all there is.
  const Index n = nu.size(), elastic = n - rigid.cols();
  const Index found = std::min<Index>((nu.array() > zero).count(), elastic);
  const VectorXd kept = nu.tail(found).reverse();
  result.values = kept.cwiseInverse().array() + sigma;
  const MatrixXd Z = solver.vectors.middleCols(n - found, found).rowwise().reverse();
  // z^T z = 1 means x^T (K - sigma M) x = 1, so x^T M x = nu.
  result.vectors = factor.solve_upper(Z) * kept.cwiseSqrt().cwiseInverse().asDiagonal();
  result.status = EigenStatus::kConverged;
  result.solves = n;
  return result;
}

/// The same from the first of the shifts `shift`, 30 `shift`, ... that makes K - sigma M definite:
/// where most of K is zero to rounding, as on a statically determinate boundary, so is the median
/// that the shift came from (hard case F1).
EigenResult solve_shifted_enough(const MatrixXd& K, const MatrixXd& M, const MatrixXd& rigid,
                                 double& shift) {
  EigenResult result;
  if (shift < 0.0) result = solve_shifted(K, M, rigid, shift);
  if (result.ok()) return result;
  double largest = 0.0;
  for (Index j = 0; j < K.rows(); ++j)
    if (M(j, j) > 0.0) largest = std::max(largest, std::abs(K(j, j)) / M(j, j));
  if (!(largest > 0.0) || !std::isfinite(largest)) largest = 1.0;  // K = 0: any shift will do
  for (double size = std::max(-shift, kFirstShift * largest); size <= kLastShift * largest;
       size *= kLargerShift) {
    shift = -size;
    result = solve_shifted(K, M, rigid, shift);
    if (result.ok()) break;
  }
  return result;
}

/// Above the rounding level of a singular matrix.
bool clearly_definite(const MatrixXd& K) {
  if (!(K.diagonal().array() > 0.0).all()) return false;
  const VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
  const dense::Cholesky factor(scale.asDiagonal() * K * scale.asDiagonal());
  return factor.reciprocal_condition() > 1e-13;
}

void keep_first(Index count, EigenResult& result) {
  if (count <= 0 || count >= result.values.size()) return;
  result.values.conservativeResize(count);
  result.vectors.conservativeResize(Eigen::NoChange, count);
}

/// Appends the pairs of `all` that its shift resolves to `out`.
void append_resolved(const EigenResult& all, double sigma, EigenResult& out) {
  const Index have = out.values.size();
  const double reach = kSpread * (all.values[have] - sigma);
  Index end = have;
  while (end < all.values.size() && all.values[end] - sigma <= reach) ++end;
  out.values.conservativeResize(end);
  out.values.tail(end - have) = all.values.segment(have, end - have);
  out.vectors.conservativeResize(all.vectors.rows(), end);
  out.vectors.rightCols(end - have) = all.vectors.middleCols(have, end - have);
}

}  // namespace

EigenResult solve_dense(const MatrixXd& K, const MatrixXd& M, double sigma, int count) {
  EigenResult result = solve_shifted(K, M, MatrixXd(K.rows(), 0), sigma);
  keep_first(count, result);
  return result;
}

EigenResult solve_dense(const MatrixXd& K, const MatrixXd& M, const MatrixXd& rigid,
                        std::optional<double> sigma, int count) {
  const bool held = !sigma && rigid.cols() == 0 && clearly_definite(K);
  double shift = sigma.value_or(held ? 0.0 : dense_shift(K, M));
  EigenResult all =
      sigma || held ? solve_shifted(K, M, rigid, shift) : solve_shifted_enough(K, M, rigid, shift);
  if (sigma || !all.ok()) {
    keep_first(count, all);
    return all;
  }
  // The lowest value first: the shift may be much larger.
  for (int k = 0; k < kShifts && all.values.size() > 0 && shift < 0.0; ++k) {
    const double lowest = all.values[0];
    // Below that it may be an unknown zero.
    if (!(lowest > -kZero * shift) || -shift < kTooFar * lowest) break;
    EigenResult closer = solve_shifted(K, M, rigid, -kClose * lowest);
    if (!closer.ok()) break;
    shift = -kClose * lowest;
    all = std::move(closer);
  }
  EigenResult out;
  out.status = EigenStatus::kConverged;
  for (int k = 0; k < kShifts; ++k) {
    out.solves += all.solves;
    const Index have = out.values.size();
    if (have >= all.values.size()) break;
    append_resolved(all, shift, out);
    const Index end = out.values.size();
    if (end >= all.values.size() || (count > 0 && end >= count)) break;
    EigenResult farther = solve_shifted(K, M, rigid, -kClose * all.values[end]);
    if (!farther.ok() || farther.values.size() <= end) break;
    shift = -kClose * all.values[end];
    all = std::move(farther);
  }
  keep_first(count, out);
  return out;
}

double dense_shift(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  std::vector<double> quotient;
  for (Index j = 0; j < K.rows(); ++j)
    if (M(j, j) > 0.0) quotient.push_back(K(j, j) / M(j, j));
  if (quotient.empty()) return 0.0;
  std::sort(quotient.begin(), quotient.end());
  return -1e-3 * std::max(quotient[quotient.size() / 2], 0.0);  // rounding may be negative
}

Eigen::MatrixXd dense_symmetric(const SparseMatrix& lower) {
  const SparseMatrix full = lower.selfadjointView<Eigen::Lower>();
  return Eigen::MatrixXd(full);
}

}  // namespace clatter::sparse
