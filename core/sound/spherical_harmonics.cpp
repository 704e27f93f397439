// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/spherical_harmonics.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace clatter::sound {
namespace {

/// Puts P_lm(z) sin(theta)^-m of one order m and all degrees into `value`, from index m.
void legendre(double z, int order, double first, std::vector<double>& value) {
  const auto at = [&](int l) -> double& { return value[l]; };
  const int degree = static_cast<int>(value.size()) - 1;
  at(order) = first;
  if (order < degree) at(order + 1) = z * std::sqrt(2.0 * order + 3.0) * first;
  for (int l = order + 2; l <= degree; ++l) {
    const double square = static_cast<double>(l) * l - static_cast<double>(order) * order;
    const double before = (l - 1.0) * (l - 1.0) - static_cast<double>(order) * order;
    const double a = std::sqrt((4.0 * l * l - 1.0) / square);
    const double b = std::sqrt((2.0 * l + 1.0) / (2.0 * l - 3.0) * before / square);
    at(l) = a * z * at(l - 1) - b * at(l - 2);
  }
}

}  // namespace

Eigen::MatrixXd spherical_harmonics(const RowMatrix& unit, int degree) {
  Eigen::MatrixXd out(unit.rows(), harmonic_count(degree));
  std::vector<double> value(static_cast<size_t>(degree) + 1);
  for (Eigen::Index d = 0; d < unit.rows(); ++d) {
    double first = 1.0 / std::sqrt(4.0 * std::numbers::pi);  // of P_mm / sin(theta)^m
    std::complex<double> turn = 1.0;                         // (sin(theta) exp(i phi))^m
    for (int m = 0; m <= degree; ++m) {
      if (m > 0) {
        first *= std::sqrt((2.0 * m + 1.0) / (2.0 * m));
        turn *= std::complex<double>(unit(d, 0), unit(d, 1));
      }
      legendre(unit(d, 2), m, first, value);
      const double scale = m > 0 ? std::numbers::sqrt2 : 1.0;
      for (int l = m; l <= degree; ++l) {
        const Eigen::Index middle = static_cast<Eigen::Index>(l) * l + l;
        const double P = scale * value[l];
        out(d, middle + m) = P * turn.real();
        if (m > 0) out(d, middle - m) = P * turn.imag();
      }
    }
  }
  return out;
}

}  // namespace clatter::sound
