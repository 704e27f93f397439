#pragma once
// Faces of a part as built or imported, before any mesh of it.
#include "core/base/child_process.hpp"
#include "core/base/config.hpp"
#include "mesh/face/face_list.hpp"

namespace clatter::mesh {

struct ListedFaces {
  FaceList list;
  FaceTriangles drawn;  // none when they were not asked for
  double metres = 1e-3;
};

/// Builds the part of a description and lists its faces. With `triangles` also as triangles of a
/// thirtieth of the part's size, 24 on a full circle, which is enough to look at and to tell which
/// side of a face is outside. A surface that selects no face, and faces that cannot be meshed, are
/// warnings: this is how one finds out. Messages begin with `where`. Errors as of
/// build_part(), and for an unknown key.
ListedFaces list_faces(const Config& config, const std::string& where, bool triangles);

/// The same in a child process. Where Gmsh falls on the triangles they are left out with a warning;
/// NumericsError when it falls on the geometry, or at a limit of time or memory.
ListedFaces list_faces_in_child(const Config& config, const std::string& where, bool triangles,
                                const ChildLimits& limits);

/// An element size for a part that nobody gave one: that of about 30 000 tetrahedra in its volume,
/// V = 30 000 h^3 / (6 sqrt 2), at most a tenth of its size; two digits. [unit of the list]
double default_element_size(const FaceList& list);

}  // namespace clatter::mesh
