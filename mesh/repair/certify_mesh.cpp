// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/certify_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"

namespace clatter::mesh {
namespace {

double refused_above(const char* name) { return judgement_of<MeshCertificate>(name).refused; }

}  // namespace

MeshCertificate certify_mesh(const Mesh& mesh, const QualityReport& quality) {
  if (mesh.cell_count() == 0) return {};  // points and springs alone
  const Surface& skin = mesh.surface("skin");
  // About a point of the part: far from the origin x . n dS is all rounding (hard case F2).
  const SurfaceIntegrals closed = integrate(mesh, skin, mesh.nodes.row(0).transpose());
  const double volume = cell_volume(mesh);
  const double against_surface = std::abs(closed.enclosed / volume - 1.0);
  const double open = closed.normal.norm() / closed.area;
  const auto inward = static_cast<double>(count_inward(mesh, skin));
  if (against_surface > refused_above("volume_against_surface_integral") ||
      open > refused_above("closed_surface_residue") || inward > refused_above("inward_normals")) {
    throw NumericsError(fmt::format(
        "mesh: the boundary is not closed and outward: volume differs by {:.3g}, |sum n dS| / area "
        "= {:.3g}, {} inward normals",
        against_surface, open, inward));
  }
  return {.cells = static_cast<double>(mesh.cell_count()),
          .nodes = static_cast<double>(mesh.nodes.rows()),
          .dofs = 3.0 * static_cast<double>(mesh.nodes.rows()),
          .volume_m3 = volume,
          .volume_against_surface_integral = against_surface,
          .closed_surface_residue = open,
          .inward_normals = inward,
          .skin_area_m2 = closed.area,
          .invalid_cells = 0.0,
          .min_scaled_jacobian = quality.scaled_jacobian.worst,
          .min_dihedral_deg = quality.min_dihedral_deg.worst,
          .max_dihedral_deg = quality.max_dihedral_deg.worst,
          .min_radius_ratio = quality.radius_ratio.worst};
}

}  // namespace clatter::mesh
