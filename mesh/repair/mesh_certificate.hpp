// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What was proved of a mesh.
#include <optional>
#include <vector>

#include "core/base/certificate.hpp"

namespace clatter::mesh {

/// The certificate of a mesh. fields() has the unit and meaning of each member, which are named as
/// in the file.
struct MeshCertificate {
  // By certify_mesh().
  double cells = 0.0, nodes = 0.0, dofs = 0.0;
  double volume_m3 = 0.0, volume_against_surface_integral = 0.0;
  double closed_surface_residue = 0.0, inward_normals = 0.0, skin_area_m2 = 0.0;
  double invalid_cells = 0.0, min_scaled_jacobian = 0.0;
  double min_dihedral_deg = 0.0, max_dihedral_deg = 0.0, min_radius_ratio = 0.0;
  std::optional<double> shell_area_m2{}, shell_triangles{}, largest_shell_warp{};
  std::optional<double> min_shell_jacobian{}, largest_shell_aspect{};
  // By note_poor_cells().
  std::optional<double> poor_cells{}, poor_cells_below_floor{}, poor_cells_volume_share{};
  std::optional<double> poor_cells_frequency_effect{}, poor_cells_most_effect{};
  // Of a sheet meshed here, by mesh_sheet().
  std::optional<double> shell_area_against_cad{};
  // Of a geometry meshed here, by mesh_part() and make_part_in_child().
  std::optional<double> predicted_cells{}, occ_volume_m3{}, cad_volume_m3{}, volume_against_cad{};
  std::optional<double> invalid_cells_before_repair{}, min_scaled_jacobian_before_repair{};
  std::optional<double> optimiser_repair{}, elastic_repair{}, nodes_off_geometry{};
  std::optional<double> largest_distance_off_geometry_m{}, simpler_setting{};

  static const std::vector<CertificateField<MeshCertificate>>& fields();
  bool operator==(const MeshCertificate&) const = default;
};

}  // namespace clatter::mesh
