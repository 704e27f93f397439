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

/// The temperatures at `nodes` (n x 3 [m]) [K]: at each node the value of the linear function that
/// fits the eight nearest points with weights 1 / distance^2 (moving least squares, Lancaster and
/// Salkauskas 1981), which is the point's own where a node lies on a point. Linear fields are
/// exact; across the plane of points that lie in one, the field is constant.
Eigen::VectorXd temperatures_at(const TemperatureTable& table, const RowMatrix& nodes);

}  // namespace clatter::assembly
