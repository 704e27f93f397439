#pragma once
// Quadratic tetrahedra without slivers and without folded cells, by every means there is.
//
// In this order, each only where the one before did not suffice:
//  1. slivers of the linear mesh are lifted (sliver.hpp), else finer cells are asked for there
//  2. curved cells that fold are unfolded by the nodes inside (unfold.hpp)
//  3. finer cells are asked for where cells stay folded, and all is meshed anew
//  4. Gmsh's HighOrder moves nodes, those of the boundary along the geometry; then Gmsh's
//     HighOrderElastic smooths the whole mesh
//  5. middle nodes are pulled off the geometry by at most a twentieth of their edge
//     (straighten.hpp): told and counted
//  6. the mesh is refused, with the faces to blame
#include "core/mesh/mesh.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/geometry/part_geometry.hpp"
#include "mesh/part/mesher.hpp"

namespace clatter::mesh {

/// What there was to repair.
struct Repair {
  size_t invalid_before = 0;  // in the mesh that was kept
  double min_ratio_before = 0.0;
  bool optimised = false;     // the local search was not enough: HighOrder
  bool elastic = false;       // nor were HighOrder and finer cells
  int64_t pulled = 0;         // middle nodes of the boundary that left the geometry
  double largest_pull = 0.0;  // by so much at most [m]
};

/// Meshes into `mesh` (regions and cells in metres; no surfaces yet); its nodes stand in the order
/// of session.extract(). NumericsError with places and faces when cells stay invalid.
Repair make_valid_mesh(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                       SizeSettings sizes, double metres_per_unit, Mesh& mesh);

}  // namespace clatter::mesh
