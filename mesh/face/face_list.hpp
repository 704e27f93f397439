// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The list of faces of a part, for naming surfaces: a table, JSON, and a file to draw.
#include <map>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/json_line.hpp"
#include "mesh/face/select.hpp"

namespace clatter::mesh {

inline constexpr const char* kFacesSchema = "clatter/faces/1";

/// Faces of a part with the surfaces that each belongs to.
struct FaceList {
  std::string name, unit = "mm";                     // of the part; of all lengths here
  double volume = 0.0;                               // of the part's solids
  bool oriented = false;                             // set by orient_faces()
  std::vector<FaceFacts> faces;                      // by ascending number
  std::map<int, std::vector<std::string>> surfaces;  // names by face number
};

/// Position of a face: the point of its axis nearest to its centre of area; a cone's apex, a
/// sphere's or torus' centre; else the centre of area.
Eigen::Vector3d position_of(const FaceFacts& face);

/// The filters that select only this face: keys of a table [surface.NAME], one per line: its
/// cylinder or plane, and the box around its edges, widened by `margin`.
std::vector<std::string> filter_lines(const FaceFacts& face, double margin);

/// Aligned columns: number, kind, radius, axis or (when oriented, outward) normal, position, area,
/// name where any face has one, surfaces; the header line gives names and units.
std::vector<std::string> table_of(const FaceList& list);

/// For --json: name, unit, and faces, one object per face: number, named, kind, spline, concave,
/// radius, minor_radius, half_angle_deg, direction, place, centre, area, box, surfaces, toml (its
/// filters).
JsonMembers json_of(const FaceList& list);

/// Triangles to draw: rows of `nodes`, and the face that each lies on.
struct FaceTriangles {
  RowMatrix nodes;         // n x 3, in the unit of the list
  IndexMatrix triangles;   // m x 3
  std::vector<int> faces;  // m
};

/// Finds the outer side of each face and sets it in the faces' shapes (orient()). CAD kernels keep
/// no reliable orientation of faces that result from booleans; here a ray from the middle of the
/// face's largest triangle decides: it starts inside when it meets the other triangles an odd
/// number of times. The majority of five rays counts, as a ray may graze an edge.
void orient_faces(FaceList& list, const FaceTriangles& drawn);

/// Writes schema "clatter/faces/1" without provenance: the table, and the triangles in metres.
void write_faces(H5File& file, const FaceList& list, const FaceTriangles& drawn,
                 double metres_per_unit);

}  // namespace clatter::mesh
