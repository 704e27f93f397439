// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Faces of a part as built or imported, without meshing it.
#include "core/base/child_process.hpp"
#include "mesh/face/face_list.hpp"
#include "mesh/part/part_file.hpp"

namespace clatter::mesh {

struct ListedFaces {
  FaceList list;
  FaceTriangles drawn;  // empty when not requested
  double metres = 1e-3;
};

/// Builds the part of a description and lists its faces. With `triangles` also as triangles of a
/// thirtieth of the part's size, 24 on a full circle, which suffices to draw the faces and to find
/// their outer side. A surface that selects no face, and faces that cannot be meshed, give
/// warnings. Messages begin with `where`. Errors as of build_part().
ListedFaces list_faces(const PartFile& file, const std::string& where, bool triangles);

/// The same in a child process. When Gmsh crashes on the triangles they are left out with a
/// warning; NumericsError when it crashes on the geometry, or at a limit of time or memory.
ListedFaces list_faces_in_child(const PartFile& file, const std::string& where, bool triangles,
                                const ChildLimits& limits);

/// The default element size of a part: that of about 30 000 tetrahedra in its volume, V = 30 000
/// h^3 / (6 sqrt 2), at most a tenth of its size; two digits. [unit of the list]
double default_element_size(const FaceList& list);

}  // namespace clatter::mesh
