// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The boundary of the solid and integrals over it (hard cases G4, G9).
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Corner nodes of a face, ascending, a triangle with -1 before them: the same for both cells that
/// share it.
using FaceKey = std::array<int32_t, 4>;
inline FaceKey face_key(FaceType type, std::span<const int32_t> nodes) {
  const auto order = [](int32_t& a, int32_t& b) {
    if (b < a) std::swap(a, b);
  };
  FaceKey key = {-1, nodes[0], nodes[1], nodes[2]};
  order(key[1], key[2]);
  order(key[2], key[3]);
  order(key[1], key[2]);
  if (traits(type).corners == 3) return key;
  key[0] = nodes[3];
  for (size_t i = 0; i < 3; ++i) order(key[i], key[i + 1]);
  return key;
}

/// A face of one cell.
struct BoundaryFace {
  FaceType type;
  std::array<int32_t, kMaxFaceNodes> ids;  // outward
  int32_t block, cell;                     // cell that has the face

  std::span<const int32_t> nodes() const {
    return std::span(ids).first(static_cast<size_t>(traits(type).nodes));
  }
};

/// Boundary faces by corner nodes.
using BoundaryFaces = std::map<FaceKey, BoundaryFace>;

/// Faces that belong to exactly one cell. InputError when two cells have the same corners (hard
/// case F4), when a face has three cells or more, or when two cells that share its corners do not
/// share its mid-side nodes: displacements would be discontinuous there.
BoundaryFaces boundary_faces(const Mesh& mesh);

/// All boundary faces as a surface, ordered by corners, then the shells.
Surface skin_of(const BoundaryFaces& faces, const std::vector<ShellBlock>& shells = {});

/// The shells of a region, -1 for all.
Surface shell_surface(const Mesh& mesh, int32_t region = -1);

/// Integrals over curved faces, exact except for the area. What x . n dS encloses is measured from
/// `about`, which a closed surface does not feel but for rounding.
struct SurfaceIntegrals {
  double area = 0.0;                                 // integral of |n| dS [m2]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // integral of n dS [m2]; 0 when closed
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // area-weighted mean of x [m]
  double enclosed = 0.0;  // (1/3) integral of x . n dS [m3]; the volume when closed
};
SurfaceIntegrals integrate(const Mesh& mesh, const Surface& surface,
                           const Eigen::Vector3d& about = Eigen::Vector3d::Zero());

/// Volume of all cells of a region, -1 for all [m3]; exact.
double cell_volume(const Mesh& mesh, int32_t region = -1);

/// Number of skin faces without a cell or with a normal into their cell, those of shells aside; 0
/// in a valid mesh.
int64_t count_inward(const Mesh& mesh, const Surface& skin);

}  // namespace clatter::mesh
