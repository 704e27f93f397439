// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The free field of many pairs of points at once, in the processor's vector registers.
#include <Eigen/Core>
#include <numbers>

namespace clatter::sound {

/// Values of Kernel for N distances: G = g_re + i g_im, slope likewise.
template <int N>
struct KernelArray {
  Eigen::Array<double, N, 1> g_re, g_im, slope_re, slope_im;
};

/// Sine and cosine of N phases below 1e6, within 1e-13: x = n pi + t, |t| <= pi / 2, and Taylor's
/// polynomials of degree 17 and 18 in t.
template <int N>
void sine_and_cosine(const Eigen::Array<double, N, 1>& x, Eigen::Array<double, N, 1>& sine,
                     Eigen::Array<double, N, 1>& cosine) {
  using Values = Eigen::Array<double, N, 1>;
  // pi in two parts, the first with 30 bits: n times it is exact.
  constexpr double kHigh = 3.1415926534682512, kLow = std::numbers::pi - kHigh;
  const Values n = (x * std::numbers::inv_pi).rint();
  const Values t = (x - n * kHigh) - n * kLow, s = t * t;
  const Values half = 0.5 * n;
  const Values sign = 1.0 - 4.0 * (half - half.rint()).abs();  // (-1)^n
  const auto series = [&](double first) {  // 1 - s/(first (first+1)) (1 - ...), nine terms
    Values sum = Values::Ones();
    for (double m = first + 16.0; m >= first; m -= 2.0)
      sum = 1.0 - s * (1.0 / (m * (m + 1.0))) * sum;
    return sum;
  };
  sine = sign * t * series(2.0);
  cosine = sign * series(1.0);
}

/// The values at squared distances r2 [m2].
template <int N>
KernelArray<N> kernels(double k, const Eigen::Array<double, N, 1>& r2) {
  using Values = Eigen::Array<double, N, 1>;
  KernelArray<N> out;
  const Values r = r2.sqrt(), phase = k * r;
  Values sine, cosine;
  sine_and_cosine<N>(phase, sine, cosine);
  const Values size = (0.25 * std::numbers::inv_pi) / r, steep = 1.0 / r2;
  out.g_re = size * cosine;
  out.g_im = -size * sine;
  out.slope_re = steep * (out.g_re - phase * out.g_im);
  out.slope_im = steep * (out.g_im + phase * out.g_re);
  return out;
}

}  // namespace clatter::sound
