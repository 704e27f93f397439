// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/valid_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/base/child_process.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/validity.hpp"
#include "mesh/repair/sliver.hpp"
#include "mesh/repair/straighten.hpp"
#include "mesh/repair/unfold.hpp"

namespace clatter::mesh {
namespace {

constexpr double kSpotFactor = 0.6;    // finer cells where slivers were
constexpr double kFoldFactor = 0.5;    // and where cells folded
constexpr size_t kHopeless = 2;        // times as many slivers or folds: the part is that sharp
constexpr int64_t kMostGrowth = 2;     // times as many cells: beyond that slivers are only reported
constexpr double kManySlivers = 0.01;  // of the cells
constexpr size_t kManyFolds = 500;     // HighOrder takes 0.2 s for each
constexpr int kHighOrders = 3;         // the next one may unfold what one left
constexpr double kLargestPull = 0.05;  // of the edge
constexpr double kPulledRatio = 0.05;  // smallest scaled Jacobian after straightening

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

double mean_edge(const Eigen::Matrix<double, 4, 3>& x) {
  double sum = 0.0;
  for (const auto& [a, b] : kTetEdges) sum += (x.row(a) - x.row(b)).norm();
  return sum / 6.0;
}

// The session's linear mesh, one block per solid, in the session's unit.
Mesh linear_mesh(const RawMesh& raw) {
  Mesh mesh;
  mesh.nodes = raw.nodes;
  for (const auto& entry : raw.cells) {
    mesh.cells.push_back({CellType::kTet4, 0, entry.second, {}});
  }
  return mesh;
}

// Where slivers cannot be removed, the size does not fit a thin wall or a sharp corner. Finer cells
// there allow better shapes.
std::vector<FineSpot> spots_at_slivers(const Mesh& mesh, double limit_deg) {
  std::vector<FineSpot> spots;
  for (const CellBlock& block : mesh.cells) {
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const Eigen::Matrix<double, 4, 3> x = corners_of(mesh, block, c);
      if (smallest_dihedral(x, limit_deg) >= limit_deg) continue;
      const double mean = mean_edge(x);
      spots.push_back({x.colwise().mean().transpose(), mean, kSpotFactor * mean});
    }
  }
  return spots;
}

// The share of the volume in cells with a smaller angle.
double share_below(const Mesh& mesh, double limit_deg) {
  double below = 0.0, all = 0.0;
  for (const CellBlock& block : mesh.cells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const Eigen::Matrix<double, 4, 3> x = corners_of(mesh, block, c);
      const double volume = (x.bottomRows<3>().rowwise() - x.row(0)).eval().determinant();
      all += volume;
      if (smallest_dihedral(x, limit_deg) < limit_deg) below += volume;
    }
  return below / all;
}

struct Slivers {
  size_t count = 0;
  int64_t cells = 0;  // of the mesh
};

// Meshes and removes slivers; while some remain, meshes again with finer spots. Leaves the attempt
// with the fewest in the session, made quadratic, and its sizes in `sizes`.
Slivers generate_without_slivers(GmshSession& session, const MeshSettings& settings,
                                 SizeSettings& sizes, bool split_corners) {
  const double target = settings.min_dihedral_deg;
  int64_t cells = 0;     // of the attempt, as Gmsh made it
  bool refused = false;  // for its flat cells
  const auto attempt = [&](const SizeSettings& trial) {
    session.generate(trial);
    RawMesh raw = session.extract();
    enter_step("removing slivers");
    Mesh linear = linear_mesh(raw);
    cells = linear.cell_count();
    int64_t edits = lift_slivers(linear, target).before;
    if (split_corners) edits += split_blunt_corners(linear, target);
    if (edits > 0) {
      raw.nodes = linear.nodes;
      size_t b = 0;
      for (auto& entry : raw.cells) entry.second = linear.cells[b++].nodes;
      session.replace_cells(raw);
    }
    refused = effect_of_share(share_below(linear, kQualityFloor.dihedral_deg)) > kMostEffect;
    return spots_at_slivers(linear, target);
  };
  SizeSettings trial = sizes;
  std::vector<FineSpot> spots = attempt(trial);
  size_t fewest = spots.size();
  const int64_t most = refused ? std::numeric_limits<int64_t>::max() : kMostGrowth * cells;
  bool is_best = true;  // the last attempt
  for (int pass = 0; !spots.empty() && pass < settings.refine_passes; ++pass) {
    say(fmt::format("mesh: {} cells have a dihedral angle below {:.1f} deg, refining there",
                    spots.size(), target));
    trial.spots.insert(trial.spots.end(), spots.begin(), spots.end());
    spots = attempt(trial);
    is_best = false;
    if (spots.size() > kHopeless * fewest || cells > most) break;
    if (spots.size() >= fewest) continue;
    fewest = spots.size();
    sizes = trial;
    is_best = true;
  }
  if (!is_best) attempt(sizes);
  session.make_quadratic();
  return {fewest, cells};
}

// Fewer are no sign of a sharp part.
size_t many_slivers(const Slivers& slivers) {
  return static_cast<size_t>(kManySlivers * static_cast<double>(slivers.cells));
}

// Where cells remain folded, the size does not fit the curvature.
void add_spots_at_folds(SizeSettings& sizes, const Mesh& mesh, const ValidityReport& folded,
                        double metres_per_unit) {
  for (const InvalidCell& cell : folded.invalid) {
    const auto x = corners_of(mesh, mesh.cells[cell.block], cell.cell);
    const double mean = mean_edge(x) / metres_per_unit;
    sizes.spots.push_back({cell.centre / metres_per_unit, mean, kFoldFactor * mean});
  }
}

// The most that cells far below the aims change frequencies; those a little below are many.
double effect_of_squeezed(const Mesh& mesh) {
  Mesh with_skin = mesh;
  with_skin.surfaces["skin"] = skin_of(boundary_faces(mesh));
  return find_poor_cells(with_skin, measure_quality(mesh), kQualityFloor).most_effect();
}

// "face 7 (Plane, centre (1, 2, 3))" of the faces that contain any of the nodes, in the part's
// unit.
std::string describe_faces_at(GmshSession& session, const std::set<int32_t>& nodes) {
  constexpr size_t kMost = 8;
  const RawMesh raw = session.extract();
  std::vector<std::string> faces;
  for (const FaceFacts& face : session.boundary_faces()) {
    const IndexMatrix& cells = raw.face_cells.at(face.tag);
    const bool holds = std::any_of(cells.data(), cells.data() + cells.size(),
                                   [&](int32_t node) { return nodes.contains(node); });
    if (!holds || faces.size() == kMost) continue;
    faces.push_back(fmt::format("face {} ({}, centre ({:.5g}, {:.5g}, {:.5g}))", face.tag,
                                face.kind == "Unknown" ? "spline" : face.kind, face.centre.x(),
                                face.centre.y(), face.centre.z()));
  }
  return fmt::format("{}", fmt::join(faces, ", "));
}

// The last remedy; `mesh` still has folded cells.
void pull_straight(GmshSession& session, const ValidityReport& folded, Mesh& mesh, Repair& repair) {
  const std::vector<PulledNode> pulled = straighten_cells(mesh, kPulledRatio);
  std::set<int32_t> too_far;
  for (const PulledNode& p : pulled)
    if (p.distance > kLargestPull * p.edge) too_far.insert(p.node);
  if (!too_far.empty())
    throw NumericsError(fmt::format(
        "mesh: {} of {} cells are invalid after repair and {} nodes would have to leave the "
        "geometry by more than {:g} of their edge; on the faces: {}: {}",
        folded.invalid.size(), mesh.cell_count(), too_far.size(), kLargestPull,
        describe_faces_at(session, too_far), describe_invalid(folded, 5)));
  repair.pulled = static_cast<int64_t>(pulled.size());
  if (!pulled.empty()) repair.largest_pull = pulled.front().distance;
  say(fmt::format("mesh: {} mid-side nodes leave the geometry, by {:.2g} m at most", repair.pulled,
                  repair.largest_pull));
}

// Nodes inside faces and curves slide along them.
Sliding sliding_of(GmshSession& session, double metres_per_unit) {
  const std::vector<size_t> tags = session.extract().node_tags;
  std::map<int32_t, PlaceOnGeometry> places;
  for (const auto& [tag, place] : session.places_of_nodes()) {
    const auto at = std::ranges::lower_bound(tags, tag);
    if (at != tags.end() && *at == tag) places[static_cast<int32_t>(at - tags.begin())] = place;
  }
  Sliding sliding;
  for (const auto& [node, place] : places) sliding.nodes.insert(node);
  sliding.onto = [&session, metres_per_unit, places](int32_t node,
                                                     const Eigen::Vector3d& x) mutable {
    return Eigen::Vector3d(metres_per_unit *
                           session.nearest_point(x / metres_per_unit, places.at(node)));
  };
  return sliding;
}

// By the local search: with the boundary as it is, then along the geometry.
ValidityReport unfold(GmshSession& session, double target, double metres_per_unit, Mesh& mesh) {
  unfold_cells(mesh, target);
  ValidityReport folded = check_validity(mesh);
  if (folded.invalid.empty() || folded.invalid.size() > kManyFolds) return folded;
  const Sliding sliding = sliding_of(session, metres_per_unit);
  for (const double aim : {kPulledRatio, target}) unfold_cells(mesh, aim, sliding);
  ValidityReport slid = check_validity(mesh);
  if (slid.invalid.size() < folded.invalid.size())
    say(fmt::format("mesh: {} of {} folded cells unfolded along the geometry",
                    folded.invalid.size() - slid.invalid.size(), folded.invalid.size()));
  return slid;
}

// Gmsh's HighOrder on the session's mesh, then the local search; kept if that is better.
void optimise(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
              double metres_per_unit, Mesh& mesh, ValidityReport& folded, Repair& repair) {
  session.optimise_curved_cells();
  Mesh trial = convert(session.extract(), part, metres_per_unit);
  unfold_cells(trial, settings.min_scaled_jacobian);
  ValidityReport report = check_validity(trial);
  if (report.min_ratio <= folded.min_ratio) return;
  mesh = std::move(trial);
  folded = std::move(report);
  repair.optimised = true;
  say("mesh: curved cells unfolded by Gmsh's HighOrder: results may differ between runs");
}

}  // namespace

Repair make_valid_mesh(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                       SizeSettings sizes, double metres_per_unit, Mesh& mesh) {
  Repair repair;
  ValidityReport folded;
  size_t fewest_folds = std::numeric_limits<size_t>::max(), fewest_slivers = fewest_folds;
  for (int pass = 0;; ++pass) {
    const Slivers slivers = generate_without_slivers(session, settings, sizes, pass > 0);
    mesh = convert(session.extract(), part, metres_per_unit);
    enter_step("unfolding curved cells");
    const ValidityReport before = check_validity(mesh);
    repair.invalid_before = before.invalid.size();
    repair.min_ratio_before = before.min_ratio;
    folded = unfold(session, settings.min_scaled_jacobian, metres_per_unit, mesh);
    // HighOrder depends on memory addresses and is not reproducible. Finer cells come first, and
    // squeezed cells without effect stay.
    fewest_folds = std::min(fewest_folds, std::max<size_t>(folded.invalid.size(), 1));
    fewest_slivers = std::min(fewest_slivers, std::max(slivers.count, many_slivers(slivers)));
    const bool last = pass >= settings.refine_passes ||
                      folded.invalid.size() > kHopeless * fewest_folds ||
                      slivers.count > kHopeless * fewest_slivers;
    if (folded.min_ratio < kQualityFloor.scaled_jacobian && (last || folded.invalid.empty()) &&
        before.invalid.size() <= kManyFolds &&
        (!folded.invalid.empty() || effect_of_squeezed(mesh) > kHarmless))
      for (int trial = 0; trial < kHighOrders && (trial == 0 || !folded.invalid.empty()); ++trial)
        optimise(session, part, settings, metres_per_unit, mesh, folded, repair);
    if (folded.invalid.empty()) return repair;
    if (last) break;
    repair.optimised = false;
    say(fmt::format("mesh: {} curved cells are still folded, refining there",
                    folded.invalid.size()));
    add_spots_at_folds(sizes, mesh, folded, metres_per_unit);
  }
  say(fmt::format("mesh: {} curved cells are still folded, smoothing the entire mesh",
                  folded.invalid.size()));
  session.repair_curved_cells();
  mesh = convert(session.extract(), part, metres_per_unit);
  unfold_cells(mesh, settings.min_scaled_jacobian);
  repair.elastic = true;
  folded = check_validity(mesh);
  if (!folded.invalid.empty()) pull_straight(session, folded, mesh, repair);
  return repair;
}

}  // namespace clatter::mesh
