// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Flat triangles as the integrals need them, and their mirror images.
#include <Eigen/Core>
#include <vector>

#include "core/sound/space.hpp"
#include "core/sound/surface.hpp"
#include "core/sound/triangle_rules.hpp"

namespace clatter::sound {

/// A triangle, or a part of one: shape functions are those of the complete triangle.
struct Facet {
  Eigen::Matrix3d corners;  // columns [m], counterclockwise seen from the fluid
  Eigen::Matrix3d shape;    // column: the shape functions at a corner
  Eigen::Vector3d normal;   // unit vector into the fluid
  double area;              // [m2]
  Eigen::Vector3d centre() const { return corners.rowwise().mean(); }
  /// Of the smallest sphere about the centre that holds the corners [m].
  double radius() const { return (corners.colwise() - centre()).colwise().norm().maxCoeff(); }
  /// One of the four parts between corners and middles of edges.
  Facet quarter(int which) const;
};

/// A facet of a surface, with what is used in each pair.
struct PreparedFacet {
  Facet facet;
  Eigen::Vector3i nodes;   // of its corners
  Eigen::Matrix3d curl;    // column a: n x grad N_a, constant [1/m]
  Eigen::Vector3d centre;  // [m]
  double radius;           // [m]
  Eigen::Matrix3d points;  // columns: of three_points() [m]
};

/// All facets of a surface.
std::vector<PreparedFacet> prepared_facets(const Surface& surface);

/// The corner of a face that corner `corner` of its facet is, or of the facet of its image.
inline int corner_of_face(int corner, bool same_surface) {
  return same_surface ? corner : (3 - corner) % 3;
}

/// The facets of the images of a surface: none without a ground plane. The corners of an image are
/// exchanged, so that its normal points into the fluid.
/// @throws InputError when the surface does not lie entirely above the plane
std::vector<PreparedFacet> image_facets(const Surface& surface, const Space& space);

}  // namespace clatter::sound
