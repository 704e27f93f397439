// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The two sides of a solid that is a sheet of constant thickness.
#include <map>
#include <optional>
#include <vector>

#include "mesh/cad/gmsh_side_depths.hpp"
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// Faces that hang together by common curves, each group ascending. @param curves of each face.
std::vector<std::vector<int>> groups_of(const std::vector<int>& faces,
                                        const std::map<int, std::vector<int>>& curves);

/// Points of the sheet's faces with their outward normals.
void take_outward(const std::vector<FaceDepths>& depths, SheetFaces& sheet);

struct SheetSides {
  double thickness = 0.0;         // in the part's unit
  std::vector<int> outer, inner;  // face tags, ascending; outer: the larger area
  std::vector<int> rims;          // the other faces
};

/// A face is of a side where the depth behind it is the thickness, of a rim where it is not; sides
/// hang together by common curves. The thickness is the median of the depth over the area.
///
/// NumericsError unless there are two sides whose mean area times the thickness is the volume
/// within 5 %: what is not constant is said with its place.
/// @param curves of each face. @param thickness of the sheet, where it is known.
SheetSides find_sides(const std::vector<FaceDepths>& faces,
                      const std::map<int, std::vector<int>>& curves, double volume,
                      std::optional<double> thickness, const std::string& unit);

}  // namespace clatter::mesh
