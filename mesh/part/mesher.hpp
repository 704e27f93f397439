// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Meshes a part's geometry and proves the mesh valid.
#include <string>

#include "core/mesh/mesh.hpp"
#include "mesh/geometry/part_geometry.hpp"
#include "mesh/repair/mesh_certificate.hpp"
#include "mesh/repair/poor_cells.hpp"
#include "mesh/repair/quality.hpp"

namespace clatter::mesh {

/// Finer cells on one named surface.
struct LocalSize {
  std::string surface;
  double factor = 1.0;        // of the element size, which still refines everything
  int elements_per_turn = 0;  // on a full circle of the surface's smallest radius; 0: unset
  double growth = 0.0;        // of the size per distance from the surface; 0: Gmsh's default
};

/// Table [mesh].
struct MeshSettings {
  double element_size = 0.012;       // key element_size_mm [m]
  double min_size = 0.0;             // key min_size_mm [m]: lower limit of sizes from curvature
  int elements_per_turn = 0;         // on a full circle; 0: ignores curvature
  double min_dihedral_deg = 8.0;     // target: cells below are remeshed with finer neighbours
  double min_scaled_jacobian = 0.2;  // target: curved cells below are unfolded
  int refine_passes = 4;             // maximum number of passes; 0: none
  double max_cells = 5e6;            // more are refused before meshing, by predict_cells()
  bool accept_poor_cells = false;    // below the floor of poor_cells.hpp: a warning, no refusal
  std::vector<LocalSize> local;      // [[mesh.local]]
  bool adaptive_faces = false;       // no key: for parts on which Gmsh's frontal algorithm crashes
};
QualityLimits aims_of(const MeshSettings& settings);
/// Of the part's size: the largest edge that Gmsh makes; larger sizes are reduced to it.
inline constexpr double kCoarsest = 0.1;

struct PartMesh {
  Mesh mesh;
  QualityReport quality;
  MeshCertificate certificate;
};

/// Meshes the part with quadratic tetrahedra, removes slivers, unfolds and proves the curved cells,
/// names the surfaces, measures quality. `where` begins messages about surfaces that select nothing
/// (InputError). NumericsError when a cell stays invalid, the boundary is not closed and outward,
/// or the mesh's volume differs from the CAD volume by more than 1 %.
PartMesh mesh_part(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                   double metres_per_unit, const std::string& name, const std::string& where);

}  // namespace clatter::mesh
