#pragma once
// The boundary of the solid and what integrals over it prove (hard cases G4, G9).
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>

#include "mesh/mesh.hpp"

namespace clatter::mesh {

/// Corner nodes of a face, ascending: the same for both cells that share it.
using FaceKey = std::array<int32_t, 3>;
FaceKey face_key(int32_t a, int32_t b, int32_t c);

/// Boundary faces by their corners: the nodes of the face, outward (f columns as in the cell type).
using BoundaryFaces = std::map<FaceKey, std::array<int32_t, 6>>;

/// Faces that belong to exactly one cell. NumericsError when a face has three cells or more.
BoundaryFaces boundary_faces(const Mesh& mesh);

/// All boundary faces as a surface, ordered by corners.
Surface skin_of(const Mesh& mesh, const BoundaryFaces& faces);

/// Integrals over curved triangles, exact for quadratic geometry.
struct SurfaceIntegrals {
  double area = 0.0;                                 // integral of |n| dS [m2]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // integral of n dS [m2]; 0 when closed
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // area-weighted mean of x [m]
  double enclosed = 0.0;  // (1/3) integral of x . n dS [m3]; the volume when closed
};
SurfaceIntegrals integrate(const Mesh& mesh, const Surface& surface);

/// Volume of all cells of a region, -1 for all [m3]; exact.
double cell_volume(const Mesh& mesh, int32_t region = -1);

/// How many skin triangles have a normal that points into their cell; 0 in a proper mesh.
int64_t count_inward(const Mesh& mesh, const Surface& skin);

}  // namespace clatter::mesh
