// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A number, or one that varies along a direction.
#include <Eigen/Core>
#include <vector>

namespace clatter::assembly {

inline constexpr double kZeroCelsius = 273.15;  // [K]

/// Linear between positions, constant beyond the first and the last.
struct Profile {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit vector; zero with one value
  std::vector<double> at;                               // direction . x, ascending [m]
  std::vector<double> value;                            // one for each position, at least one

  /// The value at position `x` [m].
  double operator()(const Eigen::Vector3d& x) const;
};

}  // namespace clatter::assembly
