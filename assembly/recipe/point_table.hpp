// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Values at points, from a CSV file, and their interpolation.
#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"

namespace clatter::assembly {

/// A quantity of a table.
struct TableColumn {
  std::string name, unit;
  double least = -std::numeric_limits<double>::infinity();  // smaller values are refused
  bool above = false;                                       // `least` itself too
};

/// Values at points, a column for each quantity.
struct PointTable {
  RowMatrix points;  // m x 3 [m]
  RowMatrix values;  // m x k
};

/// Reads a CSV file: the header "x,y,z" and the names of the columns, then a line of numbers for
/// each point, positions in `metre` metres. InputError "file:line: found ..., expected ..." for
/// anything else.
PointTable read_point_table(const std::filesystem::path& path, double metre,
                            const std::vector<TableColumn>& columns);

/// A table's values at nodes, and how far they can be trusted.
struct TableValues {
  RowMatrix values;              // n x k
  double farthest = 0.0;         // largest distance from a node to the point next to it [m]
  Eigen::RowVectorXd residuals;  // k: largest weighted root mean square that a fit leaves
};

/// The values at `nodes` (n x 3 [m]): at each node those of the linear functions that fit the
/// eight nearest points with weights 1 / distance^2 (moving least squares, Lancaster and Salkauskas
/// 1981), which are the point's own where a node lies on a point. More points are taken where the
/// node lies more than three times as far across them as they reach: points of planes that are
/// farther apart than the points in them. Linear fields are exact, the error of smooth ones is of
/// second order in the distance of points; fields are constant in a direction in which the entire
/// table does not reach.
TableValues values_at(const PointTable& table, const RowMatrix& nodes);

}  // namespace clatter::assembly
