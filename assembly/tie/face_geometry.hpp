// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Faces of the two sides of a tie, and their flat facets.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::assembly {

/// One face with its nodes' positions.
struct TieFace {
  mesh::FaceType type = mesh::FaceType::kTri6;
  std::array<int32_t, mesh::kMaxFaceNodes> nodes{};
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, mesh::kMaxFaceNodes, 3> x;  // [m]

  int size() const { return static_cast<int>(x.rows()); }
};

/// All faces of a surface.
std::vector<TieFace> tie_faces(const RowMatrix& coordinates, const mesh::Surface& surface);

/// A flat part of a face: three or four of its nodes in order. Linear faces are one facet, a tri6
/// four triangles, a quad8 four triangles at the corners and one quadrilateral between the mid-side
/// nodes.
struct Facet {
  std::array<int, 4> corners{};
  int size = 3;
};
const std::vector<Facet>& facets_of(mesh::FaceType type);

/// A plane through a point with an orthonormal frame.
struct Plane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit vector
  Eigen::Matrix<double, 2, 3> frame;                  // rows: in-plane axes

  Eigen::Vector2d project(const Eigen::Vector3d& x) const { return frame * (x - origin); }
};

/// The mean plane of a facet; its normal is that of the face (outward).
Plane plane_of(const TieFace& face, const Facet& facet);

/// The reference coordinates `xi` of the point of the face on the plane's normal through `at`, by
/// Newton's method. False when it does not converge: the face is nearly normal to the plane.
bool find_reference(const TieFace& face, const Plane& plane, const Eigen::Vector2d& at,
                    Eigen::Vector2d& xi);

/// Centre of the reference face.
Eigen::Vector2d reference_centre(mesh::FaceType type);

}  // namespace clatter::assembly
