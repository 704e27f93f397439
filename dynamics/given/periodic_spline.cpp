// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/periodic_spline.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "dynamics/given/next_point.hpp"

namespace clatter::dynamics {
namespace {

/// Values k! c_k / j! of derivative order: d^k/ds^k of the Hermite polynomial on [0, h] by
/// (y0, h y0', h^2 y0'', y1, h y1', h^2 y1''), times h^k, at its left and right end.
struct HermiteRow {
  double left[6], right[6];
};

// Cubic: second derivative by (y, h y').
constexpr HermiteRow kCubicSecond{{-6, -4, 0, 6, -2, 0}, {6, 2, 0, -6, 4, 0}};
// Quintic: third and fourth derivative by (y, h y', h^2 y'').
constexpr HermiteRow kQuinticThird{{-60, -36, -9, 60, -24, 3}, {-60, -24, -3, 60, -36, 9}};
constexpr HermiteRow kQuinticFourth{{360, 192, 36, -360, 168, -24},
                                    {-360, -168, -24, 360, -192, 36}};

/// Unknown slopes (and curvatures) at the points, from the continuity of higher derivatives.
class SlopeEquations {
 public:
  SlopeEquations(int degree, const std::vector<double>& lengths, const std::vector<double>& y)
      : per_point_(degree == 3 ? 1 : 2), h_(lengths), y_(y) {}

  /// y', or y' and y'' point by point.
  Eigen::VectorXd solve() {
    const auto n = static_cast<int>(h_.size());
    right_ = Eigen::VectorXd::Zero(per_point_ * n);
    for (int i = 0; i < n; ++i) {
      if (per_point_ == 1) {
        match(i, i, kCubicSecond, 2);
      } else {
        match(2 * i, i, kQuinticThird, 3);
        match(2 * i + 1, i, kQuinticFourth, 4);
      }
    }
    Eigen::SparseMatrix<double> matrix(per_point_ * n, per_point_ * n);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
    if (lu.info() != Eigen::Success)
      throw NumericsError("periodic spline: its equations are singular");
    return lu.solve(right_);
  }

 private:
  /// Derivative `order` is the same at the end of the interval before point i and at the begin of
  /// the one after it. Rows are scaled by the interval, so that they have the size of values.
  void match(int row, int i, const HermiteRow& hermite, int order) {
    const auto n = static_cast<int>(h_.size());
    const int before = (i + n - 1) % n, after = (i + 1) % n;
    const double scale = std::pow(h_[i], order);
    add(row, before, hermite.right, 0, before, scale, order);
    add(row, i, hermite.right, 3, before, scale, order);
    add(row, i, hermite.left, 0, i, -scale, order);
    add(row, after, hermite.left, 3, i, -scale, order);
  }
  void add(int row, int point, const double* factors, int first, int interval, double scale,
           int order) {
    const double h = h_[interval], size = scale / std::pow(h, order);
    right_(row) -= size * factors[first] * y_[point];
    double power = h;
    for (int k = 0; k < per_point_; ++k, power *= h)
      entries_.emplace_back(row, per_point_ * point + k, size * factors[first + 1 + k] * power);
  }

  int per_point_;
  const std::vector<double>& h_;
  const std::vector<double>& y_;
  Eigen::VectorXd right_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

PeriodicSpline::PeriodicSpline(int degree, std::vector<double> x, const std::vector<double>& y,
                               double period)
    : x_(std::move(x)), pieces_(x_.size()), period_(period) {
  const size_t n = x_.size();
  std::vector<double> h(n);
  for (size_t i = 0; i < n; ++i) h[i] = (i + 1 < n ? x_[i + 1] : x_.front() + period_) - x_[i];
  const Eigen::VectorXd slopes = SlopeEquations(degree, h, y).solve();
  const Eigen::Index per_point = degree == 3 ? 1 : 2;
  for (size_t i = 0; i < n; ++i) {
    const size_t j = (i + 1) % n;
    const auto slope = [&](size_t point, int k) {
      return slopes(per_point * static_cast<Eigen::Index>(point) + k) * std::pow(h[i], k + 1);
    };
    const double d = y[j] - y[i], a = slope(i, 0), b = slope(j, 0);
    double* c = pieces_[i].c;
    c[0] = y[i];
    c[1] = a;
    if (degree == 3) {
      c[2] = 3.0 * d - 2.0 * a - b;
      c[3] = a + b - 2.0 * d;
    } else {
      const double p = slope(i, 1), q = slope(j, 1);
      c[2] = 0.5 * p;
      c[3] = 10.0 * d - 6.0 * a - 4.0 * b - 1.5 * p + 0.5 * q;
      c[4] = -15.0 * d + 8.0 * a + 7.0 * b + 1.5 * p - q;
      c[5] = 6.0 * d - 3.0 * (a + b) - 0.5 * (p - q);
    }
    for (int k = 1; k < 6; ++k) c[k] /= std::pow(h[i], k);
  }
}

SplinePoint PeriodicSpline::at(double x) const {
  x -= period_ * std::floor((x - x_.front()) / period_);
  const auto after = std::upper_bound(x_.begin() + 1, x_.end(), x);
  const auto i = static_cast<size_t>(after - x_.begin()) - 1;
  const double s = x - x_[i];
  const double* c = pieces_[i].c;
  return {c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5])))),
          c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * 5 * c[5]))),
          2 * c[2] + s * (6 * c[3] + s * (12 * c[4] + s * 20 * c[5])),
          6 * c[3] + s * (24 * c[4] + s * 60 * c[5])};
}

double PeriodicSpline::next_point(double x) const { return next_periodic_point(x_, period_, x); }

}  // namespace clatter::dynamics
