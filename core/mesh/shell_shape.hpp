// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How far a linear cell of a shell is from a square or an equilateral triangle.
#include <Eigen/Core>
#include <span>

namespace clatter::mesh {

struct ShellShape {
  double area = 0.0;      // over that of a square on the longest side
  double corner = 0.0;    // smallest parallelogram at a corner over the cell's area, along the
                          // mean normal; below 0: concave or folded
  double jacobian = 0.0;  // the same over the product of the two sides; 1 of a square and of an
                          // equilateral triangle
  double upright = 1.0;   // smallest cosine between the normal at a corner and the mean one
  double warp = 0.0;      // distance between both diagonals over the root of the area
  double aspect = 1.0;    // longest side over the shortest
};

/// @param corners three or four, around the cell.
ShellShape shape_of_shell(std::span<const Eigen::Vector3d> corners);

}  // namespace clatter::mesh
