// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/tie_relations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/constraint/edge_tie.hpp"
#include "assembly/constraint/tie_rows.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::assembly {
namespace {

constexpr double kDefaultGap = 0.1;  // of the mean slave face size
constexpr double kNoArm = 1e-10;     // of the mean slave face size: rounding
constexpr int32_t kNoBolt = -1;

/// The part of the motion of a node of a shell due to its distance: its face, at the masters, turns
/// with its own rotations, of which `first` is the first.
PointMotion own_rotation_rows(int32_t first, const Eigen::Vector3d& arm) {
  const Eigen::Matrix3d lever = rigid_motion(arm).rightCols<3>();  // theta x arm
  PointMotion rows;
  for (int d = 0; d < 3; ++d)
    for (int r = 0; r < 3; ++r) {
      if (std::abs(lever(d, r)) <= kNoArm * arm.norm()) continue;  // rounding
      rows[d].dofs.push_back(first + r);
      rows[d].values.push_back(lever(d, r));
    }
  return rows;
}

/// Half the thickness of the thickest shell [m]: their faces are that far from their nodes.
double half_thickness(const PartData& part) {
  double thickest = 0.0;
  for (const mesh::ShellBlock& block : part.mesh.shells)
    thickest = std::max(thickest, block.thickness.size() > 0
                                      ? block.thickness.maxCoeff()
                                      : part.recipe.sections[block.region].thickness);
  return 0.5 * thickest;
}

/// The faces seen from their other side.
std::vector<TieFace> turned_faces(const mesh::Mesh& mesh, const std::string& surface) {
  mesh::Surface other = mesh.surface(surface);
  for (mesh::FaceBlock& block : other.faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f)
      mesh::turn_over(block.type, block.nodes.row(f));
  return tie_faces(mesh.nodes, other);
}

void say_result(const TieSpec& spec, const Projection& found, int held) {
  say(fmt::format(
      "{}: {} slave nodes tied over {:.1f} % of the slave surface, largest gap {:.3g} m", spec.name,
      found.tied.size(), 100.0 * found.covered / found.slave_area, found.largest_gap));
  if (!found.untied.empty())
    say(fmt::format("{}: {} slave nodes are not tied: no master within {:.3g} m in front of them",
                    spec.name, found.untied.size(), *spec.distance));
  if (held > 0)
    warn(fmt::format("{}: {} slave displacements are held by supports and not tied", spec.name,
                     held));
}

rom::DofSet bolt_set(const TieSpec& spec, int32_t shortening, const Eigen::Vector3d& centroid) {
  return {.kind = "bolt",
          .dofs = {shortening},
          .labels = {spec.name},
          .position = centroid.transpose(),
          .direction = spec.direction.transpose(),
          .is_rotation = {0}};
}

/// The dependences of one tie; `shortening` is the id of a bolt's, or kNoBolt.
std::vector<Dependence> tie(const PartData& part, const TieSpec& given, int32_t shortening,
                            ConstraintGraph& graph) {
  const mesh::Mesh& mesh = part.mesh;
  TieSpec spec = given;
  const Projection found = project_tie(part, spec);
  const double size = mean_size(tie_faces(mesh.nodes, mesh.surface(spec.slave)));
  const int relation = graph.add_relation(spec.where);
  std::vector<Dependence> dependences;
  int held = 0;
  for (const ProjectedNode& row : found.tied) {
    PointMotion rows = following(part, row, size, spec.where);
    for (int d = 0; d < 3; ++d) {
      const int32_t dof = 3 * row.node + d;
      if (graph.is_held(dof)) {
        ++held;
        continue;
      }
      Functional& on = rows[d];
      if (shortening != kNoBolt && spec.direction(d) != 0.0) {
        on.dofs.push_back(shortening);
        on.values.push_back(row.jump * spec.direction(d));
      }
      graph.depend(dof, on.dofs, relation);
      dependences.push_back({dof, std::move(on)});
    }
  }
  say_result(spec, found, held);
  return dependences;
}

}  // namespace

PointMotion following(const PartData& part, const ProjectedNode& row, double size,
                      const std::string& where) {
  const RowMatrix& nodes = part.mesh.nodes;
  const Eigen::Vector3d arm = arm_of(row, nodes.row(row.node).transpose(), nodes);
  const int32_t own = part.numbers.rotation_of(row.node);
  PointMotion rows;
  if (arm.norm() > kNoArm * size)
    rows = own < 0 ? rotation_rows(row, arm, nodes, where) : own_rotation_rows(own, arm);
  add_masters(row, rows);
  return rows;
}

Projection project_tie(const PartData& part, TieSpec& spec) {
  const mesh::Mesh& mesh = part.mesh;
  const std::vector<TieFace> slave = tie_faces(mesh.nodes, mesh.surface(spec.slave));
  const std::vector<TieFace> master = tie_faces(mesh.nodes, mesh.surface(spec.master));
  if (!spec.distance) spec.distance = kDefaultGap * mean_size(slave) + half_thickness(part);
  Projection found = project(slave, master, *spec.distance);
  // A sheet has two faces; its surface may be named for the other one.
  const bool sheet =
      std::ranges::any_of(
          part.recipe.parts,
          [&](const PartSpec& one) { return std::ranges::count(one.sheets, spec.slave) > 0; }) ||
      std::ranges::all_of(mesh::nodes_of(mesh.surface(spec.slave)),
                          [&](int32_t n) { return part.numbers.rotation_of(n) >= 0; });
  if (found.tied.empty() && sheet)
    found = project(turned_faces(mesh, spec.slave), master, *spec.distance);
  if (found.tied.empty())
    throw InputError(
        fmt::format("{}: found no part of {} that faces {} within {:.3g} m, expected "
                    "some",
                    spec.where, spec.slave, spec.master, *spec.distance));
  return found;
}

TieRelations gather_ties(const PartData& part, int32_t first_id, ConstraintGraph& graph) {
  TieRelations ties;
  for (const TieSpec& spec : part.recipe.ties) {
    const int32_t shortening =
        spec.bolt ? first_id + static_cast<int32_t>(ties.bolts.size()) : kNoBolt;
    for (Dependence& one :
         spec.edge.empty() ? tie(part, spec, shortening, graph) : tie_edge(part, spec, graph))
      ties.dependences.push_back(std::move(one));
    if (spec.bolt)
      ties.bolts[spec.name] = bolt_set(spec, shortening, part.surfaces.at(spec.slave).centroid);
  }
  return ties;
}

}  // namespace clatter::assembly
