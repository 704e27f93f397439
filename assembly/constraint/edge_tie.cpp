// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/edge_tie.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>

#include "assembly/constraint/tie_rows.hpp"
#include "assembly/tie/face_search.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/fe/shell_directors.hpp"
#include "core/mesh/free_edges.hpp"

namespace clatter::assembly {
namespace {

constexpr double kSameDirector = 1e-6;  // squared distance of unit vectors
constexpr double kCoarse = 3.0;         // thicknesses: wider cells of the solid stiffen the foot
constexpr double kEdgeGap = 0.5;        // of the thickness

/// One end of the footprint: a node of the edge with a director.
struct Foot {
  int32_t node = -1;
  Eigen::Vector3d V;
  double thickness = 0.0, offset = 0.0;                    // [m]
  const ProjectedNode *outer = nullptr, *inner = nullptr;  // u+, u-; null: not tied
};

/// The feet of an edge, and the faces between their four corners.
class Footprint {
 public:
  Footprint(const PartData& part, const TieSpec& spec)
      : part_(part), first_(static_cast<int32_t>(part.mesh.nodes.rows())) {
    const mesh::Mesh& mesh = part.mesh;
    const std::vector<int32_t>& set = mesh.node_set(spec.edge);
    std::vector<mesh::ShellSide> edges = mesh::free_edges(mesh.shells);
    std::erase_if(edges, [&](const mesh::ShellSide& edge) {
      return !std::ranges::binary_search(set, edge.a) || !std::ranges::binary_search(set, edge.b);
    });
    if (edges.empty())
      throw InputError(
          fmt::format("{}: found no free edge of a sheet between nodes of {}, expected "
                      "some",
                      spec.where, spec.edge));
    const std::vector<RowMatrix> directors = fe::shell_directors(mesh.nodes, mesh.shells);
    for (const mesh::ShellSide& edge : edges) {
      const mesh::FaceTraits& cell = mesh::traits(mesh.shells[edge.block].type);
      const Eigen::Index next = (edge.from + 1) % cell.corners;
      if (cell.order == 1) {
        add(edge, edge.from, next, directors[edge.block]);
        continue;
      }
      const Eigen::Index middle = cell.corners + edge.from;
      add(edge, edge.from, middle, directors[edge.block]);
      add(edge, middle, next, directors[edge.block]);
    }
  }

  std::vector<Foot>& feet() { return feet_; }
  const std::vector<TieFace>& faces() const { return faces_; }
  double thickest() const {
    return std::ranges::max_element(feet_, {}, &Foot::thickness)->thickness;
  }

  /// The corner of a foot on the side of its director, or on the other one.
  Eigen::Vector3d corner(const Foot& foot, bool outer) const {
    const double z = foot.offset + (outer ? 0.5 : -0.5) * foot.thickness;
    return part_.mesh.nodes.row(foot.node).transpose() + z * foot.V;
  }

  /// Of a face, across the sheet.
  const Eigen::Vector3d& across(const TieFace& face) const {
    return feet_[static_cast<size_t>(face.nodes[0] - first_) / 2].V;
  }
  size_t node_count() const { return at_node_.size(); }

  /// Takes the corners' projections.
  void take(const std::vector<ProjectedNode>& tied) {
    for (const ProjectedNode& row : tied) {
      Foot& foot = feet_[static_cast<size_t>(row.node - first_) / 2];
      ((row.node - first_) % 2 == 0 ? foot.outer : foot.inner) = &row;
    }
  }

 private:
  /// From node i to node j of the cell.
  void add(const mesh::ShellSide& edge, Eigen::Index i, Eigen::Index j,
           const RowMatrix& directors) {
    const mesh::ShellBlock& block = part_.mesh.shells[edge.block];
    const Eigen::Index n = block.nodes.cols(), c = edge.cell;
    const auto at = [&](Eigen::Index k) -> Eigen::Vector3d {
      return part_.mesh.nodes.row(block.nodes(c, k)).transpose();
    };
    Eigen::Vector3d out = 0.5 * (at(i) + at(j));
    for (Eigen::Index k = 0; k < n; ++k) out -= at(k) / static_cast<double>(n);
    const size_t a = foot_of(block, c, i, directors), b = foot_of(block, c, j, directors);
    TieFace face;
    face.type = mesh::FaceType::kQuad4;
    face.x.resize(4, 3);
    const bool same = feet_[a].V.dot(feet_[b].V) > 0.0;
    const std::array<std::pair<size_t, bool>, 4> around = {
        {{a, false}, {b, !same}, {b, same}, {a, true}}};
    for (size_t k = 0; k < 4; ++k) {
      const auto& [foot, outer] = around[k];
      face.nodes[k] = first_ + static_cast<int32_t>(2 * foot) + (outer ? 0 : 1);
      face.x.row(static_cast<Eigen::Index>(k)) = corner(feet_[foot], outer).transpose();
    }
    const Eigen::Vector3d first = face.x.row(1) - face.x.row(0),
                          last = face.x.row(3) - face.x.row(0);
    if (first.cross(last).dot(out) < 0.0) {
      std::swap(face.nodes[1], face.nodes[3]);
      face.x.row(1).swap(face.x.row(3));
    }
    faces_.push_back(face);
  }

  size_t foot_of(const mesh::ShellBlock& block, Eigen::Index c, Eigen::Index i,
                 const RowMatrix& directors) {
    Foot foot;
    foot.node = block.nodes(c, i);
    foot.V = directors.row(c).segment<3>(3 * i).transpose();
    const fe::ShellSection& section = part_.recipe.sections[block.region];
    foot.thickness = block.thickness.size() > 0 ? block.thickness(c, i) : section.thickness;
    foot.offset = block.offset.size() > 0 ? block.offset(c) : section.offset;
    for (const size_t known : at_node_[foot.node]) {
      const Eigen::Vector3d& V = feet_[known].V;
      if (std::min((V - foot.V).squaredNorm(), (V + foot.V).squaredNorm()) < kSameDirector)
        return known;
    }
    at_node_[foot.node].push_back(feet_.size());
    feet_.push_back(foot);
    return feet_.size() - 1;
  }

  const PartData& part_;
  int32_t first_;  // corner of the first foot, of numbers behind those of the nodes
  std::vector<Foot> feet_;
  std::vector<TieFace> faces_;
  std::map<int32_t, std::vector<size_t>> at_node_;
};

/// u+ and u- of a foot.
struct CornerMotions {
  PointMotion outer, inner;
};

CornerMotions motions_of(const Footprint& footprint, const Foot& foot, const RowMatrix& nodes,
                         const std::string& where) {
  const auto motion = [&](const ProjectedNode& row, bool outer) {
    const Eigen::Vector3d arm = arm_of(row, footprint.corner(foot, outer), nodes);
    PointMotion out;
    if (arm.norm() > 1e-10 * foot.thickness) out = rotation_rows(row, arm, nodes, where);
    add_masters(row, out);
    return out;
  };
  return {motion(*foot.outer, true), motion(*foot.inner, false)};
}

/// The displacement of a node: the mean over its feet.
PointMotion displacement_of(const std::vector<const Foot*>& feet,
                            const std::vector<CornerMotions>& corners) {
  PointMotion u;
  const double share = 1.0 / static_cast<double>(feet.size());
  for (size_t f = 0; f < feet.size(); ++f)
    for (int d = 0; d < 3; ++d) {
      const double skew = feet[f]->offset / feet[f]->thickness;
      add(share * (0.5 - skew), corners[f].outer[d], u[d]);
      add(share * (0.5 + skew), corners[f].inner[d], u[d]);
    }
  return u;
}

/// A theta = sum of t V x (u+ - u-), A = sum of t^2 (1 - V V^T): the normal equations of
/// t theta x V = u+ - u-. One foot leaves the rotation about its director free: it is taken from
/// the component that has most of it.
class Rotation {
 public:
  Rotation(const std::vector<const Foot*>& feet, const std::vector<CornerMotions>& corners) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    for (const Foot* foot : feet)
      A += foot->thickness * foot->thickness *
           (Eigen::Matrix3d::Identity() - foot->V * foot->V.transpose());
    if (feet.size() == 1) {
      axis_ = feet[0]->V;
      axis_->cwiseAbs().maxCoeff(&free_);
      A += feet[0]->thickness * feet[0]->thickness * *axis_ * axis_->transpose();
    }
    const Eigen::Matrix3d inverse = A.inverse();
    for (size_t f = 0; f < feet.size(); ++f) {
      const Eigen::Vector3d tV = feet[f]->thickness * feet[f]->V;
      for (int e = 0; e < 3; ++e) {
        const Eigen::Vector3d by = inverse * tV.cross(Eigen::Vector3d::Unit(e));
        for (int r = 0; r < 3; ++r) {
          add(by(r), corners[f].outer[e], theta_[r]);
          add(-by(r), corners[f].inner[e], theta_[r]);
        }
      }
    }
  }

  bool depends(int r) const { return !axis_ || r != free_; }

  /// Of a component that depends; `first` is the DoF of the first component.
  Functional row(int r, int32_t first) const {
    Functional out = theta_[static_cast<size_t>(r)];
    if (!axis_) return out;
    const double share = (*axis_)(r) / (*axis_)(free_);
    if (std::abs(share) < 1e-12) return out;
    out.dofs.push_back(first + static_cast<int32_t>(free_));
    out.values.push_back(share);
    add(-share, theta_[static_cast<size_t>(free_)], out);
    return out;
  }

 private:
  PointMotion theta_;
  std::optional<Eigen::Vector3d> axis_;  // of the rotation that stays free
  Eigen::Index free_ = -1;
};

void say_edge(const TieSpec& spec, const Footprint& footprint, const Projection& found,
              const std::vector<TieFace>& master, size_t tied, int held) {
  say(fmt::format("{}: the edge follows {} over {:.1f} % of its footprint, largest gap {:.3g} m",
                  spec.name, spec.master, 100.0 * found.covered / found.slave_area,
                  found.largest_gap));
  if (tied < footprint.node_count())
    warn(fmt::format(
        "{}: {} of {} nodes of the edge {} are not tied: they do not stand on {} within "
        "{:.3g} m",
        spec.name, footprint.node_count() - tied, footprint.node_count(), spec.edge, spec.master,
        *spec.distance));
  if (held > 0)
    warn(fmt::format("{}: {} displacements and rotations are held by supports and not tied",
                     spec.name, held));
  const FaceSearch search(master, *spec.distance);
  double widest = 0.0;
  for (const TieFace& face : footprint.faces())
    for (const int32_t near : search.near(box_of(face))) {
      const Eigen::VectorXd y = master[static_cast<size_t>(near)].x * footprint.across(face);
      widest = std::max(widest, y.maxCoeff() - y.minCoeff());
    }
  if (widest > kCoarse * footprint.thickest())
    warn(
        fmt::format("{}: the cells of {} at the edge are {:.3g} m wide, of a sheet {:.3g} m thick: "
                    "beyond three thicknesses the foot is too stiff, by 2 to 3 % of a frequency; "
                    "finer cells there",
                    spec.name, spec.master, widest, footprint.thickest()));
}

/// The edge on its master.
struct TiedEdge {
  TieSpec spec;
  Footprint footprint;
  std::vector<TieFace> master;
  Projection found;
  std::map<int32_t, std::vector<const Foot*>> nodes;  // the tied ones, with their feet

  TiedEdge(const PartData& part, const TieSpec& given) : spec(given), footprint(part, given) {
    if (!spec.distance) spec.distance = kEdgeGap * footprint.thickest();
    master = tie_faces(part.mesh.nodes, part.mesh.surface(spec.master));
    found = project(footprint.faces(), master, *spec.distance);
    footprint.take(found.tied);
    for (const Foot& foot : footprint.feet())
      if (foot.outer != nullptr && foot.inner != nullptr) nodes[foot.node].push_back(&foot);
    if (nodes.empty())
      throw InputError(
          fmt::format("{}: found no part of the edge {} that stands on {} within {:.3g} "
                      "m, expected some",
                      spec.where, spec.edge, spec.master, *spec.distance));
  }
  TiedEdge(const TiedEdge&) = delete;  // feet point into `found`
  TiedEdge& operator=(const TiedEdge&) = delete;
};

}  // namespace

Projection project_edge(const PartData& part, const TieSpec& spec) {
  const TiedEdge edge(part, spec);
  Projection out;
  for (const auto& [node, feet] : edge.nodes) {
    ProjectedNode& mean = out.tied.emplace_back();
    mean.node = node;
    for (const Foot* foot : feet)
      for (const ProjectedNode* corner : {foot->outer, foot->inner})
        for (const auto& [master, value] : corner->on)
          mean.on[master] += 0.5 * value / static_cast<double>(feet.size());
  }
  return out;
}

std::vector<Dependence> tie_edge(const PartData& part, const TieSpec& given,
                                 ConstraintGraph& graph) {
  const mesh::Mesh& mesh = part.mesh;
  const TiedEdge edge(part, given);
  const TieSpec& spec = edge.spec;
  const int relation = graph.add_relation(spec.where);
  std::vector<Dependence> dependences;
  int held = 0;
  const auto depend = [&](int32_t dof, Functional on) {
    if (graph.is_held(dof)) {
      ++held;
      return;
    }
    graph.depend(dof, on.dofs, relation);
    dependences.push_back({dof, std::move(on)});
  };
  for (const auto& [node, feet] : edge.nodes) {
    std::vector<CornerMotions> corners;
    for (const Foot* foot : feet)
      corners.push_back(motions_of(edge.footprint, *foot, mesh.nodes, spec.where));
    PointMotion u = displacement_of(feet, corners);
    for (int d = 0; d < 3; ++d) depend(3 * node + d, std::move(u[d]));
    const Rotation rotation(feet, corners);
    const int32_t first = part.numbers.rotation_of(node);
    for (int r = 0; r < 3; ++r)
      if (rotation.depends(r)) depend(first + r, rotation.row(r, first));
  }
  say_edge(spec, edge.footprint, edge.found, edge.master, edge.nodes.size(), held);
  return dependences;
}

}  // namespace clatter::assembly
