// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How much material lies behind the faces of solids.
#include <Eigen/Core>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {

/// Points of one face of a solid, in the part's unit.
struct FaceDepths {
  int face = 0;  // tag
  double area = 0.0;
  Eigen::Vector3d centre;                        // of the area
  std::vector<Eigen::Vector3d> points, outward;  // unit normals out of the solid; none of a face
                                                 // narrower than its edges' tolerance
  std::vector<double> depth;  // from each point straight in to the next face; infinite: none
};

/// Of all faces of all solids, by ascending tag. NumericsError where OpenCASCADE fails.
std::vector<FaceDepths> depths_behind_faces(GmshSession& session);

}  // namespace clatter::mesh
