// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/certify_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "mesh/repair/shell_quality.hpp"

namespace clatter::mesh {
namespace {

double refused_above(const char* name) { return judgement_of<MeshCertificate>(name).refused; }

}  // namespace

MeshCertificate certify_mesh(const Mesh& mesh, const QualityReport& quality) {
  MeshCertificate out;
  if (mesh.cell_count() == 0) return out;  // points and springs alone
  const auto nodes = static_cast<double>(mesh.nodes.rows());
  out.cells = static_cast<double>(mesh.cell_count());
  out.nodes = nodes;
  out.dofs = 3.0 * (nodes + static_cast<double>(turning_nodes(mesh).size()));
  // About a point of the part: far from the origin x . n dS is all rounding (hard case F2).
  const Eigen::Vector3d about = mesh.nodes.row(0).transpose();
  out.skin_area_m2 = integrate(mesh, mesh.surface("skin"), about).area;
  if (!mesh.shells.empty()) {
    out.shell_area_m2 = integrate(mesh, shell_surface(mesh)).area;
    note_shells(measure_shells(mesh), out);
  }
  if (mesh.cells.empty()) return out;
  const Surface& skin = mesh.shells.empty() ? mesh.surface("skin") : skin_of(boundary_faces(mesh));
  const SurfaceIntegrals closed = integrate(mesh, skin, about);
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
  out.volume_m3 = volume;
  out.volume_against_surface_integral = against_surface;
  out.closed_surface_residue = open;
  out.inward_normals = inward;
  out.min_scaled_jacobian = quality.scaled_jacobian.worst;
  out.min_dihedral_deg = quality.min_dihedral_deg.worst;
  out.max_dihedral_deg = quality.max_dihedral_deg.worst;
  out.min_radius_ratio = quality.radius_ratio.worst;
  return out;
}

}  // namespace clatter::mesh
