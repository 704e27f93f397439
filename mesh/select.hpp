#pragma once
// Faces of a part found by where they lie, never by number: booleans and imports renumber freely
// (hard case G5).
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/config.hpp"

namespace clatter::mesh {

/// Points on each curve of FaceFacts::edge_points: they hit the four quadrants of a full circle.
inline constexpr int kEdgeSamples = 33;

/// What is known of one face of the geometry, in the part's length unit.
struct FaceFacts {
  int tag = 0;
  std::string kind;  // "Plane", "Cylinder", "Torus", ...
  double area = 0.0;
  double radius = 0.0;                          // of a cylinder, else 0
  Eigen::Vector3d centre;                       // centre of the area
  std::vector<Eigen::Vector3d> edge_points;     // samples of the boundary curves
  std::vector<Eigen::Vector3d> surface_points;  // samples of the surface that carries the face
};

struct CylinderFilter {
  double radius;
  Eigen::Vector3d point, axis;  // a point on the axis, unit direction
};
struct PlaneFilter {
  Eigen::Vector3d normal;  // unit
  double height;           // normal . x
};
struct BoxFilter {
  Eigen::Vector3d min, max;
};

/// All parts that are given must hold.
struct SurfaceFilter {
  std::optional<CylinderFilter> cylinder;  // the face lies on this cylinder
  std::optional<PlaneFilter> plane;        // the face lies in this plane
  std::optional<BoxFilter> box;            // the whole face lies inside
  std::vector<BoxFilter> outside;          // the face lies wholly inside none of these
};

/// A surface of the mesh: the faces that any of the filters selects.
struct NamedSurface {
  std::string name;
  std::vector<SurfaceFilter> filters;
};

bool matches(const FaceFacts& face, const SurfaceFilter& filter, double tolerance);

/// Tags of the selected faces, ascending. InputError, beginning with `where`, that lists what
/// faces there are when nothing is selected.
std::vector<int> select_faces(const std::vector<FaceFacts>& faces, const NamedSurface& surface,
                              double tolerance, const std::string& where);

/// Reads the tables [surface.NAME] with the keys cylinder = {radius, point, axis},
/// plane = {normal, height}, box = {min, max}, outside = {min, max}; lengths in the part's unit.
std::vector<NamedSurface> read_named_surfaces(const Config& config);

/// "12 planes, cylinders of radius 20 (4), 53.5 (4)".
std::string describe_faces(const std::vector<FaceFacts>& faces);

}  // namespace clatter::mesh
