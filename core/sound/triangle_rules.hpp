// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Quadrature on one triangle, and on a pair of triangles that touch.
#include <Eigen/Core>
#include <vector>

namespace clatter::sound {

/// Points of a rule as barycentric coordinates, which are also the linear shape functions there.
struct TriangleRule {
  Eigen::Matrix3Xd shape;  // column: the shape functions at a point
  Eigen::VectorXd weight;  // sums to 1: times the area
};

/// Three inner points, exact to degree 2, and six points, exact to degree 4 (Cowper 1973).
const TriangleRule& three_points();
const TriangleRule& six_points();

/// Number of corners that two triangles share.
enum class Contact { kVertex = 1, kEdge = 2, kSame = 3 };

/// A rule for pairs of points of two triangles.
struct PairRule {
  Eigen::Matrix3Xd shape_x, shape_y;  // column: the shape functions at x and y of a pair
  Eigen::VectorXd weight;             // sums to 1: times both areas
};

/// The rule of Sauter and Schwab 2011, section 5.2: transformations that cancel the singularity of
/// 1/r and of its normal derivatives, with four Gauss points a coordinate. The shared corners are
/// the first ones of both triangles, in the same sequence.
const PairRule& touching_rule(Contact contact);

}  // namespace clatter::sound
