// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/spline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "dynamics/given/next_point.hpp"

namespace clatter::dynamics {
namespace {

/// Slope at a point between intervals of lengths h and secants s at its left (0) and right (1).
double harmonic_slope(double h0, double s0, double h1, double s1) {
  if (s0 * s1 <= 0.0) return 0.0;
  const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / s0 + w1 / s1);
}

}  // namespace

std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const size_t n = x.size();
  const auto h = [&](size_t i) { return x[i + 1] - x[i]; };
  const auto secant = [&](size_t i) { return (y[i + 1] - y[i]) / h(i); };
  std::vector<double> slope(n);
  slope.front() = secant(0);
  slope.back() = secant(n - 2);
  for (size_t i = 1; i + 1 < n; ++i)
    slope[i] = harmonic_slope(h(i - 1), secant(i - 1), h(i), secant(i));
  return slope;
}

Spline::Spline(Kind kind, std::vector<double> x, std::vector<double> y, double period)
    : kind_(kind), x_(std::move(x)), y_(std::move(y)), period_(period) {
  if (period_ > 0.0) {
    x_.push_back(x_.front() + period_);
    y_.push_back(y_.front());
  }
  const size_t n = x_.size();
  slope_.assign(n, 0.0);
  if (kind_ == Kind::kLinear || n < 2) return;
  slope_ = monotone_slopes(x_, y_);
  if (period_ <= 0.0) return;
  const double first = x_[1] - x_[0], last = x_[n - 1] - x_[n - 2];
  slope_.front() = slope_.back() =
      harmonic_slope(last, (y_[n - 1] - y_[n - 2]) / last, first, (y_[1] - y_[0]) / first);
}

double Spline::operator()(double at) const {
  if (period_ > 0.0) at -= period_ * std::floor((at - x_.front()) / period_);
  if (at <= x_.front() || x_.size() == 1) return y_.front();
  if (at >= x_.back()) return y_.back();
  const auto right = static_cast<size_t>(std::upper_bound(x_.begin(), x_.end(), at) - x_.begin());
  const size_t i = right - 1;
  const double h = x_[right] - x_[i], t = (at - x_[i]) / h;
  if (kind_ == Kind::kLinear) return y_[i] + t * (y_[right] - y_[i]);
  const double u = 1.0 - t;
  return y_[i] * u * u * (1.0 + 2.0 * t) + y_[right] * t * t * (3.0 - 2.0 * t) +
         h * t * u * (slope_[i] * u - slope_[right] * t);
}

double Spline::next_point(double at) const {
  if (period_ <= 0.0) {
    const auto next = std::upper_bound(x_.begin(), x_.end(), at);
    return next == x_.end() ? std::numeric_limits<double>::infinity() : *next;
  }
  return next_periodic_point(std::span(x_).first(x_.size() - 1), period_,
                             at);  // but the closing one
}

double Spline::slope(double at) const {
  if (period_ > 0.0) at -= period_ * std::floor((at - x_.front()) / period_);
  if (at < x_.front() || at > x_.back() || x_.size() == 1) return 0.0;
  const auto right =
      static_cast<size_t>(std::upper_bound(x_.begin() + 1, x_.end() - 1, at) - x_.begin());
  const size_t i = right - 1;
  const double h = x_[right] - x_[i], t = (at - x_[i]) / h, u = 1.0 - t;
  const double secant = (y_[right] - y_[i]) / h;
  if (kind_ == Kind::kLinear) return secant;
  return 6.0 * t * u * secant + slope_[i] * u * (1.0 - 3.0 * t) +
         slope_[right] * t * (3.0 * t - 2.0);
}

}  // namespace clatter::dynamics
