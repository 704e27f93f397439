#include "mesh/mesher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/log.hpp"
#include "mesh/boundary.hpp"
#include "mesh/certify_mesh.hpp"
#include "mesh/sliver.hpp"
#include "mesh/unfold.hpp"
#include "mesh/validity.hpp"

namespace clatter::mesh {
namespace {

constexpr double kSelectTolerance = 1e-6;  // of the part's size; CAD kernels keep about 1e-7
constexpr double kVolumeTolerance = 0.01;  // coarse facets on thin round walls stay below

constexpr double kSpotFactor = 0.6;  // finer cells where slivers were

using FaceTags = std::map<std::string, std::vector<int>>;

double size_of_part(const std::vector<FaceFacts>& faces) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
  for (const FaceFacts& face : faces) {
    for (const Eigen::Vector3d& x : face.edge_points) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  }
  return (high - low).norm();
}

FaceTags find_surfaces(const std::vector<FaceFacts>& faces, const PartGeometry& part,
                       const std::string& where) {
  const double tolerance = kSelectTolerance * size_of_part(faces);
  FaceTags tags;
  for (const NamedSurface& surface : part.surfaces) {
    tags[surface.name] = select_faces(faces, surface, tolerance, where);
  }
  return tags;
}

SizeSettings size_settings(const MeshSettings& settings, const FaceTags& surfaces,
                           double metres_per_unit, const std::string& where) {
  SizeSettings sizes;
  sizes.size = settings.element_size / metres_per_unit;
  sizes.min_size = settings.min_size / metres_per_unit;
  sizes.per_turn = settings.elements_per_turn;
  for (const LocalSize& local : settings.local) {
    const auto found = surfaces.find(local.surface);
    if (found == surfaces.end()) {
      std::string names;
      for (const auto& entry : surfaces) names += (names.empty() ? "" : ", ") + entry.first;
      throw InputError(fmt::format("{}: mesh.local: surface '{}' not found, expected one of: {}",
                                   where, local.surface, names.empty() ? "none" : names));
    }
    for (int tag : found->second) sizes.face_sizes[tag] = local.factor * sizes.size;
  }
  return sizes;
}

Mesh convert(const RawMesh& raw, const PartGeometry& part, double metres_per_unit) {
  Mesh mesh;
  mesh.nodes = raw.nodes * metres_per_unit;
  for (const RegionSolids& region : part.regions) {
    Eigen::Index rows = 0;
    for (Solid s : region.solids) rows += raw.cells.at(s).rows();
    CellBlock block{CellType::kTet10, static_cast<int32_t>(mesh.regions.size()), {}, {}};
    block.nodes.resize(rows, 10);
    rows = 0;
    for (Solid s : region.solids) {
      const IndexMatrix& cells = raw.cells.at(s);
      block.nodes.middleRows(rows, cells.rows()) = cells;
      rows += cells.rows();
    }
    mesh.regions.push_back(region.name);
    mesh.cells.push_back(std::move(block));
  }
  return mesh;
}

// Four corner rows of a cell.
Eigen::Matrix<double, 4, 3> corners_of(const Mesh& mesh, const CellBlock& block, Eigen::Index c) {
  Eigen::Matrix<double, 4, 3> x;
  for (int i = 0; i < 4; ++i) x.row(i) = mesh.nodes.row(block.nodes(c, i));
  return x;
}

// The session's linear mesh, one block a solid, in the session's unit.
Mesh linear_mesh(const RawMesh& raw) {
  Mesh mesh;
  mesh.nodes = raw.nodes;
  for (const auto& entry : raw.cells) {
    mesh.cells.push_back({CellType::kTet4, 0, entry.second, {}});
  }
  return mesh;
}

// Where slivers cannot be lifted, the size does not fit a thin wall or a sharp corner. Finer cells
// there make room for better ones.
std::vector<FineSpot> spots_at_slivers(const Mesh& mesh, double limit_deg) {
  std::vector<FineSpot> spots;
  for (const CellBlock& block : mesh.cells) {
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const Eigen::Matrix<double, 4, 3> x = corners_of(mesh, block, c);
      if (dihedral_angles(x).minCoeff() >= limit_deg) continue;
      double mean = 0.0;
      for (const auto& [a, b] : kTetEdges) mean += (x.row(a) - x.row(b)).norm() / 6.0;
      spots.push_back({x.colwise().mean().transpose(), mean, kSpotFactor * mean});
    }
  }
  return spots;
}

// Meshes and lifts slivers; while some stay, meshes again with finer spots. Leaves the attempt with
// the fewest in the session, made quadratic.
void generate_without_slivers(GmshSession& session, const MeshSettings& settings,
                              SizeSettings sizes) {
  const double target = settings.min_dihedral_deg;
  const auto attempt = [&](const SizeSettings& trial) {
    session.generate(trial);
    RawMesh raw = session.extract();
    Mesh linear = linear_mesh(raw);
    if (lift_slivers(linear, target).before > 0) {
      raw.nodes = linear.nodes;
      size_t b = 0;
      for (auto& entry : raw.cells) entry.second = linear.cells[b++].nodes;
      session.replace_cells(raw);
    }
    return linear;
  };
  SizeSettings best = sizes;
  size_t fewest = std::numeric_limits<size_t>::max();
  for (int pass = 0;; ++pass) {
    const auto spots = spots_at_slivers(attempt(sizes), target);
    if (spots.size() < fewest) {
      fewest = spots.size();
      best = sizes;
    }
    if (spots.empty()) break;
    if (pass == settings.refine_passes) {
      attempt(best);
      break;
    }
    say(fmt::format("mesh: {} cells have a dihedral angle below {:.1f} deg, refining there",
                    spots.size(), target));
    sizes.spots.insert(sizes.spots.end(), spots.begin(), spots.end());
  }
  session.make_quadratic();
}

/// What there was to repair.
struct Repair {
  size_t invalid_before = 0;
  double min_ratio_before = 0.0;
  bool elastic = false;  // the local search was not enough
};

// Folded cells are unfolded near by; if some stay, Gmsh's elastic smoother moves the whole mesh.
Repair make_valid(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                  double metres_per_unit, Mesh& mesh) {
  const ValidityReport before = check_validity(mesh);
  Repair repair{before.invalid.size(), before.min_ratio};
  unfold_cells(mesh, settings.min_scaled_jacobian);
  ValidityReport after = check_validity(mesh);
  if (!after.invalid.empty()) {
    say(fmt::format("mesh: {} curved cells stay folded, smoothing the whole mesh",
                    after.invalid.size()));
    session.repair_curved_cells();
    mesh = convert(session.extract(), part, metres_per_unit);
    unfold_cells(mesh, settings.min_scaled_jacobian);
    after = check_validity(mesh);
    repair.elastic = true;
  }
  if (!after.invalid.empty()) {
    throw NumericsError(fmt::format(
        "mesh: {} of {} cells stay invalid after repair, choose smaller elements there: {}",
        after.invalid.size(), mesh.cell_count(), describe_invalid(after, 5)));
  }
  return repair;
}

// Gmsh's triangles say which face they lie on; the cell they belong to says where outside is.
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

std::map<std::string, double> certify(const Mesh& mesh, const QualityReport& quality,
                                      double cad_volume) {
  auto certificate = certify_mesh(mesh, quality);
  const double volume = certificate.at("volume_m3");
  const double against_cad = volume / cad_volume - 1.0;
  if (std::abs(against_cad) > kVolumeTolerance) {
    throw NumericsError(
        fmt::format("mesh: volume {:.9g} m3, expected the CAD volume {:.9g} m3 "
                    "within 1 %: choose smaller elements or more per turn",
                    volume, cad_volume));
  }
  certificate["cad_volume_m3"] = cad_volume;
  certificate["volume_against_cad"] = against_cad;
  return certificate;
}

}  // namespace

MeshSettings read_mesh_settings(const Config& config) {
  MeshSettings settings;
  const auto table = config.find_table("mesh");
  if (!table) return settings;
  settings.element_size =
      1e-3 * table->number_or("element_size_mm", 1e3 * settings.element_size, Range::positive());
  settings.min_size = 1e-3 * table->number_or("min_size_mm", 0.0, Range::not_negative());
  settings.elements_per_turn =
      static_cast<int>(table->integer_or("elements_per_turn", 0, {0.0, 1000.0}));
  settings.min_dihedral_deg =
      table->number_or("min_dihedral_deg", settings.min_dihedral_deg, {0.0, 60.0});
  settings.min_scaled_jacobian =
      table->number_or("min_scaled_jacobian", settings.min_scaled_jacobian, {0.0, 0.9});
  settings.refine_passes =
      static_cast<int>(table->integer_or("refine_passes", settings.refine_passes, {0.0, 20.0}));
  if (settings.min_size > settings.element_size) {
    table->fail("min_size_mm", "expected at most element_size_mm");
  }
  for (const Config& local : table->tables("local")) {
    const std::string surface = local.text("surface");
    settings.local.push_back({surface, local.number("factor", {0.0, 1.0, true})});
  }
  return settings;
}

PartMesh mesh_part(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                   double metres_per_unit, const std::string& name, const std::string& where) {
  const FaceTags tags = find_surfaces(session.boundary_faces(), part, where);
  double cad_volume = 0.0;
  for (const RegionSolids& region : part.regions) cad_volume += session.volume(region.solids);
  cad_volume *= metres_per_unit * metres_per_unit * metres_per_unit;

  PartMesh result;
  generate_without_slivers(session, settings,
                           size_settings(settings, tags, metres_per_unit, where));
  result.mesh = convert(session.extract(), part, metres_per_unit);
  const Repair repair = make_valid(session, part, settings, metres_per_unit, result.mesh);
  const RawMesh raw = session.extract();
  Mesh& mesh = result.mesh;
  mesh.name = name;
  const BoundaryFaces boundary = boundary_faces(mesh);
  mesh.surfaces["skin"] = skin_of(boundary);
  for (const auto& [surface, faces] : tags) {
    mesh.surfaces[surface] = surface_of(raw, faces, boundary);
    mesh.node_sets[surface] = nodes_of(mesh.surfaces[surface]);
  }
  check_structure(mesh, "mesh");
  result.quality = measure_quality(mesh);
  result.certificate = certify(mesh, result.quality, cad_volume);
  result.certificate["invalid_cells_before_repair"] = static_cast<double>(repair.invalid_before);
  result.certificate["min_scaled_jacobian_before_repair"] = repair.min_ratio_before;
  result.certificate["elastic_repair"] = repair.elastic ? 1.0 : 0.0;
  return result;
}

}  // namespace clatter::mesh
