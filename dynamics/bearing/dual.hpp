// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Numbers with their derivatives: a formula written once gives both.
#include <Eigen/Core>
#include <cmath>

namespace clatter::dynamics {

/// A value and its derivatives by n variables (forward differentiation, Griewank and Walther 2008).
template <int n>
struct Dual {
  using Derivatives = Eigen::Matrix<double, n, 1>;
  double value = 0.0;
  Derivatives by = Derivatives::Zero();

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: constants mix with variables in formulas
  Dual(double at, const Derivatives& derivatives) : value(at), by(derivatives) {}
  /// The variable number k.
  static Dual variable(double at, int k) { return {at, Derivatives::Unit(k)}; }
  /// f(x) of a function with value and slope at x.
  Dual chained(double f, double slope) const { return {f, slope * by}; }

  friend Dual operator-(const Dual& a) { return {-a.value, -a.by}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.by + b.by}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.by - b.by}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.by * b.value + a.value * b.by};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return {quotient, (a.by - quotient * b.by) / b.value};
  }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.chained(root, 0.5 / root);
  }
  friend Dual sin(const Dual& a) { return a.chained(std::sin(a.value), std::cos(a.value)); }
  friend Dual cos(const Dual& a) { return a.chained(std::cos(a.value), -std::sin(a.value)); }
  friend Dual asin(const Dual& a) {
    return a.chained(std::asin(a.value), 1.0 / std::sqrt(1.0 - a.value * a.value));
  }
  friend Dual atan(const Dual& a) {
    return a.chained(std::atan(a.value), 1.0 / (1.0 + a.value * a.value));
  }
};

}  // namespace clatter::dynamics
