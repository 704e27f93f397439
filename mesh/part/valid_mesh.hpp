// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Quadratic tetrahedra without slivers and without folded cells.
//
// In this order, each step only if the previous one did not suffice:
//  1. slivers of the linear mesh are removed (sliver.hpp), else cells there are refined
//  2. folded curved cells are unfolded by moving interior nodes (unfold.hpp)
//  3. the part is remeshed with finer cells where cells remain folded
//  4. Gmsh's HighOrder moves nodes, those of the boundary along the geometry; then Gmsh's
//     HighOrderElastic smooths the entire mesh
//  5. mid-side nodes are pulled off the geometry by at most a twentieth of their edge
//     (straighten.hpp): reported and counted
//  6. the mesh is refused; the message names the faces
#include "core/mesh/mesh.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/geometry/part_geometry.hpp"
#include "mesh/part/mesher.hpp"

namespace clatter::mesh {

/// The repairs that were made.
struct Repair {
  size_t invalid_before = 0;  // in the mesh that was kept
  double min_ratio_before = 0.0;
  bool optimised = false;     // the local search was not enough: HighOrder
  bool elastic = false;       // nor were HighOrder and finer cells
  int64_t pulled = 0;         // boundary mid-side nodes that left the geometry
  double largest_pull = 0.0;  // largest distance from the geometry [m]
};

/// Meshes into `mesh` (regions and cells in metres; no surfaces yet); its nodes are in the order of
/// session.extract(). NumericsError with positions and faces when cells stay invalid.
Repair make_valid_mesh(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                       SizeSettings sizes, double metres_per_unit, Mesh& mesh);

}  // namespace clatter::mesh
