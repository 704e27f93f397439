// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A number, one that varies along a direction, or one at each node.
#include <Eigen/Core>
#include <vector>

#include "core/fe/heat.hpp"

namespace clatter::assembly {

inline constexpr double kZeroCelsius = 273.15;  // [K]

/// Linear between positions, constant beyond the first and the last; or values at nodes.
struct Profile {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit vector; zero with one value
  std::vector<double> at;                               // direction . x, ascending [m]
  std::vector<double> value;                            // one for each position, at least one
  Eigen::VectorXd nodal{};                              // n_nodes, instead of these; or empty

  /// The value at position `x` [m].
  double operator()(const Eigen::Vector3d& x) const;
};

/// The same for the integrals of heat.
fe::SurfaceValue on_surface(const Profile& profile);

}  // namespace clatter::assembly
