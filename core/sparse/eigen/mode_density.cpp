// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/mode_density.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/sparse.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"

namespace clatter::sparse {
namespace {

constexpr int kSteps = 10;  // nodes of a quadrature
constexpr int kVectors = 2 * kLanes;
static_assert(kSteps * kVectors == ModeDensity::kSolves);

using Eigen::MatrixXd;
using Columns = Eigen::Array<double, 1, kVectors>;

/// Recurrence coefficients of all vectors, side by side.
struct Recurrence {
  Eigen::Array<double, kSteps, kVectors> alpha, beta;
};

Recurrence lanczos(const SubtreeProduct& A, int64_t size, uint64_t seed) {
  std::mt19937_64 engine(seed);
  RowMatrix q(size, kVectors), before = RowMatrix::Zero(size, kVectors), x, z(size, kVectors);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < q.size(); ++i) q.data()[i] = normal(engine);
  q.array().rowwise() /= q.colwise().norm().array().eval();
  Recurrence out;
  Columns last = Columns::Zero();
  for (int step = 0; step < kSteps; ++step) {
    x = q;
    A.apply(A.full_tree(), x.data(), z.data(), kVectors, true);
    z.array() -= before.array().rowwise() * last;
    const Columns alpha = z.cwiseProduct(q).colwise().sum().array();
    z.array() -= q.array().rowwise() * alpha;
    last = z.colwise().norm().array();
    out.alpha.row(step) = alpha;
    out.beta.row(step) = last;
    before.swap(q);
    q = z.array().rowwise() / last.max(1e-300);
  }
  return out;
}

/// The count at nu by one random vector.
double interpolated(const std::vector<ModeDensity::Point>& points, double nu) {
  const auto next =
      std::find_if(points.begin(), points.end(), [&](const auto& point) { return point.nu <= nu; });
  if (next == points.begin()) return 0.0;
  const auto& last = *std::prev(next);
  if (next == points.end()) return last.count;
  const double part = std::log(nu / last.nu) / std::log(next->nu / last.nu);
  return last.count * std::pow(next->count / last.count, part);
}

}  // namespace

ModeDensity::ModeDensity(const SubtreeProduct& A, int64_t size, uint64_t seed) {
  const Recurrence found = lanczos(A, size, seed);
  for (int v = 0; v < kVectors; ++v) {
    const dense::Eigenpairs ritz =
        dense::tridiagonal_eigen(found.alpha.col(v), found.beta.col(v).head(kSteps - 1));
    double above = 0.0;
    std::vector<Point> points;
    for (int k = kSteps; k-- > 0;) {  // half of a node's weight lies on each side of it
      const double nu = ritz.values[k];
      const double weight = std::pow(ritz.vectors(0, k), 2) * static_cast<double>(size);
      if (nu <= 0.0) break;
      points.push_back({nu, above + 0.5 * weight});
      above += weight;
    }
    vectors_.push_back(std::move(points));
  }
}

double ModeDensity::count_above(double nu) const {
  double sum = 0.0;
  for (const auto& points : vectors_) sum += interpolated(points, nu);
  return sum / kVectors;
}

double ModeDensity::nu_above(double count) const {
  double low = vectors_[0].back().nu, high = vectors_[0].front().nu;
  for (const auto& points : vectors_) {
    low = std::min(low, points.back().nu);
    high = std::max(high, points.front().nu);
  }
  while (high > 1.001 * low) {
    const double mean = std::sqrt(low * high);
    (count_above(mean) >= count ? low : high) = mean;
  }
  return low;
}

}  // namespace clatter::sparse
