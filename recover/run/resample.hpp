// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Values between uniform samples: band-limited for motion, by polynomials for the smooth relation
// of time and crank angle.
#include <Eigen/Core>

#include "core/base/matrix.hpp"

namespace clatter::recover {

/// Samples on each side of an instant that its value depends on.
inline constexpr int kHalfWidth = 20;
/// Share of half the sampling frequency up to which a tone comes back with its amplitude and phase,
inline constexpr double kPassband = 0.8;
/// and with this error at most, relative to its amplitude.
inline constexpr double kResamplingError = 2.1e-6;

/// Values at fractional sample positions by the sinc series, truncated by a Kaiser window:
///
///   x(p) = sum_k x_k sinc(p - k) I_0(beta sqrt(1 - ((p - k)/kHalfWidth)^2)) / I_0(beta)
///
/// with weights that sum to one (Kaiser 1974; Smith and Gossett 1984); beta = 12.265 for 120 dB.
/// @param samples n x columns
/// @param positions m, each in [kHalfWidth - 1, n - 1 - kHalfWidth + 1]; 0 is the first sample
/// @return m x columns
RowMatrix resample(const RowMatrix& samples, const Eigen::VectorXd& positions);

/// y at `x` by the polynomial through the six nearest of the points (x_i, y_i), fewer at less than
/// six points (Neville's scheme, Stoer and Bulirsch 2002); the error is of order six in their
/// distance.
/// @param x_i ascending
double interpolate(const Eigen::VectorXd& x_i, const Eigen::VectorXd& y_i, double x);

}  // namespace clatter::recover
