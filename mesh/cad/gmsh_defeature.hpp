// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Removal of small faces from a CAD part: fillets, chamfers, shallow grooves, tiny holes and
// bosses.
//
// OpenCASCADE removes a face and extends its neighbours until they meet (BRepAlgoAPI_Defeaturing),
// then merges faces and edges that lie on one surface or curve (ShapeUpgrade_UnifySameDomain).
// Where the neighbours do not meet, as at a step between parallel faces, the face is kept.
#include <Eigen/Core>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {

/// What was removed and what that changed, in the part's unit.
struct Defeatured {
  Solids solids;
  int faces_before = 0, faces_after = 0;
  int narrow_faces = 0;  // faces narrower than the limit
  struct Kept {
    double width;
    Eigen::Vector3d position;
  };
  std::vector<Kept> kept;  // narrow faces that could not be removed
  double volume_before = 0.0, volume_after = 0.0;
  Eigen::Vector3d box_before = Eigen::Vector3d::Zero(), box_after = Eigen::Vector3d::Zero();
};

/// Removes all faces narrower than `below` (part's unit; width is 2 area / perimeter, that of a
/// long strip) from the session's solids, which get new numbers. NumericsError when OpenCASCADE
/// fails or leaves no valid solid, or when the volume changes by more than the fraction
/// kMostRemoved: then `below` is too large for a small feature.
Defeatured defeature(GmshSession& session, const Solids& solids, double below);
inline constexpr double kMostRemoved = 0.01;

}  // namespace clatter::mesh
