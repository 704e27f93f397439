// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/mesh_certificate.hpp"

namespace clatter::mesh {

const std::vector<CertificateField<MeshCertificate>>& MeshCertificate::fields() {
  using C = MeshCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"cells", &C::cells, "", "number of cells"},
      {"nodes", &C::nodes, "", "number of nodes"},
      {"dofs", &C::dofs, "", "three per node, six per node of shells"},
      {"predicted_cells", &C::predicted_cells, "",
       "number of cells predicted from volume and sizes before meshing"},
      {"volume_m3", &C::volume_m3, "m3", "volume of the cells"},
      {"volume_against_surface_integral", &C::volume_against_surface_integral, "",
       "the same against the integral of x n / 3 over the skin, relative difference",
       good_up_to(1e-10, "cells overlap or the skin is not theirs", 1e-10)},
      {"closed_surface_residue", &C::closed_surface_residue, "",
       "length of the sum of n dS over the skin, over its area",
       good_up_to(1e-10, "the skin has holes", 1e-10)},
      {"inward_normals", &C::inward_normals, "", "faces of the skin that point in",
       good_up_to(0.0, "the skin is turned inside out there", 0.0)},
      {"skin_area_m2", &C::skin_area_m2, "m2", "area of the skin"},
      {"shell_area_m2", &C::shell_area_m2, "m2", "area of the shells, which belong to it"},
      {"occ_volume_m3", &C::occ_volume_m3, "m3", "OpenCASCADE's volume of the geometry"},
      {"cad_volume_m3", &C::cad_volume_m3, "m3",
       "the volume taken as the CAD's: that, or the one of a finer skin"},
      {"volume_against_cad", &C::volume_against_cad, "",
       "volume of the cells against it, relative difference",
       good_up_to(0.02, "the mesh is too coarse for the part's shape, or holes were closed", 0.2)},
      {"invalid_cells", &C::invalid_cells, "", "cells with det J <= 0 somewhere",
       good_up_to(0.0, "stiffness and mass of such cells mean nothing", 0.0)},
      {"invalid_cells_before_repair", &C::invalid_cells_before_repair, "",
       "the same before any repair"},
      {"min_scaled_jacobian", &C::min_scaled_jacobian, "", "smallest det J over its mean"},
      {"min_scaled_jacobian_before_repair", &C::min_scaled_jacobian_before_repair, "",
       "the same before any repair"},
      {"optimiser_repair", &C::optimiser_repair, "", "1: Gmsh's HighOrder optimiser ran"},
      {"elastic_repair", &C::elastic_repair, "", "1: its elastic smoothing of the entire mesh ran"},
      {"nodes_off_geometry", &C::nodes_off_geometry, "",
       "nodes that the repair left off the CAD faces"},
      {"largest_distance_off_geometry_m", &C::largest_distance_off_geometry_m, "m",
       "their largest distance from the faces"},
      {"min_dihedral_deg", &C::min_dihedral_deg, "deg", "smallest angle between faces of a cell"},
      {"max_dihedral_deg", &C::max_dihedral_deg, "deg", "largest angle between faces of a cell"},
      {"min_radius_ratio", &C::min_radius_ratio, "",
       "of tetrahedra: smallest 3 r_in / r_circum, 1 for a regular one"},
      {"poor_cells", &C::poor_cells, "", "cells below the targets of quality"},
      {"poor_cells_below_floor", &C::poor_cells_below_floor, "",
       "of these, cells under 0.1 deg or a scaled Jacobian of 0.02"},
      {"poor_cells_volume_share", &C::poor_cells_volume_share, "", "their share of the volume"},
      {"poor_cells_frequency_effect", &C::poor_cells_frequency_effect, "",
       "estimated relative change of frequencies by them",
       good_up_to(0.005,
                  "flat cells stiffen the part: smaller elements there, or a simpler shape")},
      {"poor_cells_most_effect", &C::poor_cells_most_effect, "",
       "the most that they can change frequencies, relative",
       good_up_to(0.05, "a mesh made here is refused above it, unless with --accept-poor-cells")},
      {"simpler_setting", &C::simpler_setting, "",
       "0: meshed as requested; 1: Gmsh succeeded only without `elements_per_turn`, 2: only with "
       "MeshAdapt on the faces"}};
  return list;
}

}  // namespace clatter::mesh
