#pragma once
// Small faces taken out of a CAD part: fillets, chamfers, shallow grooves, tiny holes and bosses.
//
// OpenCASCADE removes a face and lets its neighbours grow together (BRepAlgoAPI_Defeaturing), then
// faces and edges that lie on one surface or curve are united (ShapeUpgrade_UnifySameDomain).
// Where the neighbours do not meet, as beside a step between parallel faces, the face stays.
#include <Eigen/Core>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {

/// What was taken out and what that changed, in the part's unit.
struct Defeatured {
  Solids solids;
  int faces_before = 0, faces_after = 0;
  int narrow_faces = 0;  // faces narrower than the limit
  struct Kept {
    double width;
    Eigen::Vector3d position;
  };
  std::vector<Kept> kept;  // narrow faces that could not be taken out
  double volume_before = 0.0, volume_after = 0.0;
  Eigen::Vector3d box_before = Eigen::Vector3d::Zero(), box_after = Eigen::Vector3d::Zero();
};

/// Takes out all faces narrower than `below` (part's unit; width is 2 area / circumference, that of
/// a long strip) of the session's solids, which get new
/// numbers. NumericsError when OpenCASCADE fails or leaves no sound solid, or when the volume moves
/// by more than kMostRemoved of itself: then `below` is no small feature's size.
Defeatured defeature(GmshSession& session, const Solids& solids, double below);
inline constexpr double kMostRemoved = 0.01;

}  // namespace clatter::mesh
