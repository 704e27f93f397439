// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/mesher.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/child_process.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/boundary.hpp"
#include "mesh/part/mesh_sizes.hpp"
#include "mesh/part/predict_cells.hpp"
#include "mesh/part/sheet_mesher.hpp"
#include "mesh/part/solid_volumes.hpp"
#include "mesh/part/valid_mesh.hpp"
#include "mesh/repair/certify_mesh.hpp"

namespace clatter::mesh {
namespace {

constexpr double kVolumeTolerance = 0.01;  // coarse facets on thin curved walls are below

// Gmsh's triangles give their face; the cell they belong to gives the outer side.
Surface surface_of(const RawMesh& raw, const std::vector<int>& tags,
                   const BoundaryFaces& boundary) {
  SurfaceBuilder surface;
  for (int tag : tags) {
    const IndexMatrix& faces = raw.face_cells.at(tag);
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
      const std::array<int32_t, 3> corners = {faces(f, 0), faces(f, 1), faces(f, 2)};
      const BoundaryFace& face = boundary.at(face_key(FaceType::kTri3, corners));
      surface.add(face.type, face.ids);
    }
  }
  return surface.finish();
}

// A face's triangles have the face's own normal: 1 where that points out of the solid, else -1.
int side_of(const IndexMatrix& triangles, const BoundaryFaces& boundary) {
  const std::array<int32_t, 3> corners = {triangles(0, 0), triangles(0, 1), triangles(0, 2)};
  const BoundaryFace& outward = boundary.at(face_key(FaceType::kTri3, corners));
  const auto at = std::find(outward.ids.begin(), outward.ids.begin() + 3, corners[0]);
  return outward.ids[static_cast<size_t>(at - outward.ids.begin() + 1) % 3] == corners[1] ? 1 : -1;
}

// Volume enclosed by a skin twice as fine as the mesh [cubed unit of the part].
double volume_of_finer_skin(GmshSession& session, const RawMesh& raw, const BoundaryFaces& boundary,
                            SizeSettings sizes) {
  sizes.size /= 2.0;
  sizes.min_size /= 2.0;
  sizes.per_turn *= 2;
  for (auto& entry : sizes.face_sizes) entry.second /= 2.0;
  for (Gradation& gradation : sizes.gradations) gradation.size /= 2.0;
  const std::vector<FaceFacts> faces = session.boundary_faces();
  const RawMesh fine = session.generate_skin(sizes);
  Mesh mesh;
  mesh.nodes = fine.nodes;
  double volume = 0.0;
  for (const FaceFacts& face : faces) {
    Surface surface;
    surface.faces = {{FaceType::kTri6, fine.face_cells.at(face.tag)}};
    volume += side_of(raw.face_cells.at(face.tag), boundary) * integrate(mesh, surface).enclosed;
  }
  return volume;
}

double cad_volume_of(const GmshSession& session, const PartGeometry& part) {
  double volume = 0.0;
  for (const RegionSolids& region : part.regions) volume += session.volume(region.solids);
  return volume;
}

// Where OpenCASCADE's integral over the solid and the mesh disagree, one of them is wrong: it takes
// a fixed number of points on splines of any length, and has large errors on wavy ones.
void certify_volume(GmshSession& session, const PartGeometry& part, const RawMesh& raw,
                    const BoundaryFaces& boundary, const SizeSettings& sizes,
                    double metres_per_unit, MeshCertificate& certificate) {
  const double cubed = metres_per_unit * metres_per_unit * metres_per_unit;
  const double volume = certificate.volume_m3;
  double cad_volume = cubed * cad_volume_of(session, part);
  certificate.occ_volume_m3 = cad_volume;
  if (std::abs(volume / cad_volume - 1.0) > kVolumeTolerance) {
    const double integrated = cubed * volume_of_finer_skin(session, raw, boundary, sizes);
    if (std::abs(volume / integrated - 1.0) > kVolumeTolerance)
      throw NumericsError(
          fmt::format("mesh: volume {:.9g} m3, expected the CAD volume {:.9g} m3 (or {:.9g} by a "
                      "finer skin) within 1 %",
                      volume, cad_volume, integrated));
    say(
        fmt::format("mesh: OpenCASCADE integrates the part to {:.6g} m3, a skin twice as fine to "
                    "{:.6g} m3: the second is used as the CAD volume",
                    cad_volume, integrated));
    cad_volume = integrated;
  }
  certificate.cad_volume_m3 = cad_volume;
  certificate.volume_against_cad = volume / cad_volume - 1.0;
}

}  // namespace

QualityLimits aims_of(const MeshSettings& settings) {
  return {settings.min_dihedral_deg, settings.min_scaled_jacobian};
}

PartMesh mesh_part(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                   double metres_per_unit, const std::string& name, const std::string& where) {
  if (part.sheet) return mesh_sheet(session, part, settings, metres_per_unit, name, where);
  const std::vector<FaceFacts> faces = session.boundary_faces();
  const FaceTags tags = find_surfaces(faces, part.surfaces, part.unit, where);
  const SizeSettings sizes = size_settings(session, settings, faces, tags, metres_per_unit, where);
  const double predicted = require_few_cells(session, cad_volume_of(session, part), sizes, settings,
                                             metres_per_unit, where);
  PartMesh result;
  const Repair repair =
      make_valid_mesh(session, part, settings, sizes, metres_per_unit, result.mesh);
  const RawMesh raw = session.extract();
  enter_step("proving the mesh");
  Mesh& mesh = result.mesh;
  mesh.name = name;
  const BoundaryFaces boundary = boundary_faces(mesh);
  mesh.surfaces["skin"] = skin_of(boundary);
  for (const auto& [surface, selected] : tags) {
    mesh.surfaces[surface] = surface_of(raw, selected, boundary);
    mesh.node_sets[surface] = nodes_of(mesh.surfaces[surface]);
  }
  check_structure(mesh, "mesh");
  result.quality = measure_quality(mesh);
  result.certificate = certify_mesh(mesh, result.quality);
  check_solid_volumes(part, mesh, metres_per_unit, where);
  certify_volume(session, part, raw, boundary, sizes, metres_per_unit, result.certificate);
  result.certificate.predicted_cells = predicted;
  result.certificate.invalid_cells_before_repair = static_cast<double>(repair.invalid_before);
  result.certificate.min_scaled_jacobian_before_repair = repair.min_ratio_before;
  result.certificate.optimiser_repair = repair.optimised ? 1.0 : 0.0;
  result.certificate.elastic_repair = repair.elastic ? 1.0 : 0.0;
  result.certificate.nodes_off_geometry = static_cast<double>(repair.pulled);
  result.certificate.largest_distance_off_geometry_m = repair.largest_pull;
  return result;
}

}  // namespace clatter::mesh
