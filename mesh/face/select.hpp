// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Selection of faces by position or by their names, never by number: booleans and imports renumber
// them (hard case G5).
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "mesh/face/face_shape.hpp"

namespace clatter::mesh {

/// Points per curve of FaceFacts::edge_points: they include the four quadrants of a full circle.
inline constexpr int kEdgeSamples = 33;

/// Properties of one face of the geometry, in the part's length unit.
struct FaceFacts {
  int tag = 0;
  std::string kind;  // "Plane", "Cylinder", "Torus", ...
  std::string name;  // in the CAD file; or empty
  double area = 0.0;
  double radius = 0.0;                          // of a cylinder, else 0
  SurfaceShape shape;                           // kind, radius and axis as measured
  Eigen::Vector3d centre;                       // centre of the area
  std::vector<Eigen::Vector3d> edge_points;     // samples of the boundary curves
  std::vector<Eigen::Vector3d> surface_points;  // samples of the face's underlying surface
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

/// All filters that are given must match.
struct SurfaceFilter {
  std::string named;                       // of the face in the CAD file; or empty
  std::optional<CylinderFilter> cylinder;  // the face lies on this cylinder
  std::optional<PlaneFilter> plane;        // the face lies in this plane
  std::optional<BoxFilter> box;            // the entire face lies inside
  std::vector<BoxFilter> outside;          // the face lies entirely inside none of these
};

/// A surface of the mesh: the faces that any of the filters selects.
struct NamedSurface {
  std::string name;
  std::vector<SurfaceFilter> filters;
  double tolerance = 0.0;  // largest distance of a face from the filter; 0: as below
};

/// Limits of selection without a `tolerance`, as fractions of the part's size. A face within the
/// first one matches: CAD kernels keep about 1e-7. Only when no face is that close, those within
/// the second are taken with a warning: dimensions may be read off a drawing.
inline constexpr double kExactSelection = 1e-6;
inline constexpr double kNearSelection = 1e-4;

/// Distance of the face from the filter: the largest of
///   named      infinite where the face has another name
///   cylinder   | distance of x from the axis - radius |, over the points x of edges and surface
///   plane      | normal . x - height |
///   box        how far an edge extends outside
/// and infinite when the face lies entirely in a box of `outside`, to within `exact`. [part's unit]
double distance_from(const FaceFacts& face, const SurfaceFilter& filter, double exact);

/// Whether the face lies within `tolerance` of the filter.
bool matches(const FaceFacts& face, const SurfaceFilter& filter, double tolerance);

/// The part in which faces are selected.
struct SelectionScale {
  double size = 1.0;        // diagonal of the part
  std::string unit = "mm";  // its unit, for messages
};

/// Selected faces, and what to report to the user.
struct Selection {
  std::vector<int> tags;              // ascending
  std::vector<std::string> warnings;  // selected faces that match only approximately
  std::vector<std::string> remarks;   // near matches that were left out
};

/// The faces that a surface selects. InputError, beginning with `where`, when there are none: it
/// names the three nearest with their distances, and counts the faces of the part; or the names
/// that its faces have.
Selection select_faces(const std::vector<FaceFacts>& faces, const NamedSurface& surface,
                       const SelectionScale& scale, const std::string& where);

/// A table [surface.NAME]; lengths in the part's unit.
struct SurfaceTable {
  SurfaceFilter filter;
  std::optional<BoxFilter> outside;
  double tolerance = 0.0;
};
const keys::Keys<SurfaceTable>& surface_keys();
/// The tables as surfaces; `config`: the file, for messages.
std::vector<NamedSurface> named_surfaces(const Config& config,
                                         const std::map<std::string, SurfaceTable>& tables);

/// Diagonal of the box around all edges of the faces.
double size_of_part(const std::vector<FaceFacts>& faces);

/// "12 planes, cylinders of radius 20 (4), 53.5 (4)".
std::string describe_faces(const std::vector<FaceFacts>& faces);

}  // namespace clatter::mesh
