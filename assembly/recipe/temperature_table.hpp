// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Temperatures at points, from a CSV file, and their interpolation.
#include <Eigen/Core>
#include <filesystem>

#include "core/base/matrix.hpp"

namespace clatter::assembly {

/// Temperatures at points.
struct TemperatureTable {
  RowMatrix points;             // m x 3 [m]
  Eigen::VectorXd temperature;  // m [K]
};

/// Reads a CSV file: the header "x,y,z,temperature_c", then a line of four numbers for each point,
/// positions in `metre` metres, temperatures in degrees Celsius. InputError "file:line: found ...,
/// expected ..." for anything else.
TemperatureTable read_temperature_table(const std::filesystem::path& path, double metre);

/// A table's values at nodes, and how far they can be trusted.
struct TableValues {
  Eigen::VectorXd temperature;  // n [K]
  double farthest;              // largest distance from a node to the point next to it [m]
  double residual;              // largest weighted root mean square that a fit leaves [K]
};

/// The temperatures at `nodes` (n x 3 [m]): at each node the value of the linear function that fits
/// the eight nearest points with weights 1 / distance^2 (moving least squares, Lancaster and
/// Salkauskas 1981), which is the point's own where a node lies on a point. More points are taken
/// where the node lies more than three times as far across them as they reach: points of planes
/// that are farther apart than the points in them. Linear fields are exact; the field is constant
/// in a direction in which the entire table does not reach.
TableValues temperatures_at(const TemperatureTable& table, const RowMatrix& nodes);

}  // namespace clatter::assembly
