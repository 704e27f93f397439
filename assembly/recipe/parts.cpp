// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assembly/recipe/recipe_names.hpp"
#include "core/base/log.hpp"
#include "core/fe/free_motions.hpp"
#include "core/rom/placement.hpp"

namespace clatter::assembly {
namespace {

constexpr double kOrthogonal = 1e-6;  // of the products of a node's directions

/// Where the x, y, z of a part lie.
rom::Placement placement_of(const recipe::Part& part, const recipe::File& file) {
  rom::Placement at;
  if (!part.system.empty()) {
    check_known(part.source, "system", part.system, names_of(file.systems));
    const fe::Axes& axes = file.systems.at(part.system).axes;
    if (axes.kind != fe::Axes::Kind::kRectangular)
      part.source.fail("system", fmt::format("found \"{}\", which is not rectangular, expected one "
                                             "that is",
                                             part.system));
    at = {axes.origin, axes.frame};
  }
  if (part.mirror != recipe::Part::Mirror::kNone)
    at.frame.col(static_cast<int>(part.mirror) - 1) *= -1.0;
  return at;
}

rom::ReducedModel read_part(const recipe::Part& part, const recipe::File& file) {
  rom::ReducedModel model = rom::read_reduced_model(part.file);
  std::vector<int32_t> all(static_cast<size_t>(model.size()));
  std::iota(all.begin(), all.end(), 0);
  if (model.inertia_force.rows() > 0 || fe::free_motions(model, all).cols() < 6)
    part.source.fail("file", fmt::format("found {}, which supports or springs to the ground hold, "
                                         "expected a free part: [[support]] holds the assembly",
                                         part.file.string()));
  if (!model.modal_damping.empty())
    warn(
        fmt::format("{}: the modal damping of {} is left out: give that of the assembly in its "
                    ".rom.toml",
                    where(part.source, "part"), part.name));
  return rom::placed(std::move(model), placement_of(part, file));
}

/// The DoFs of one node of a set: entries of the set.
struct NodeOfSet {
  std::vector<size_t> displacements, rotations;
};

/// Runs of DoFs at one position; a fourth displacement begins another node there.
std::vector<NodeOfSet> split_nodes(const rom::DofSet& set) {
  std::vector<NodeOfSet> nodes;
  for (size_t k = 0; k < set.dofs.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const bool turns = set.is_rotation[k] != 0;
    if (k == 0 || set.position.row(row) != set.position.row(row - 1) ||
        (turns ? nodes.back().rotations : nodes.back().displacements).size() == 3)
      nodes.emplace_back();
    (turns ? nodes.back().rotations : nodes.back().displacements).push_back(k);
  }
  return nodes;
}

/// Adds what one part has to the mesh.
class Attachment {
 public:
  Attachment(PartSpec& spec, mesh::Mesh& mesh) : spec_(spec), mesh_(mesh) {
    spec_.coordinates.resize(static_cast<size_t>(spec_.model.size()));
  }

  /// @param own number of own coordinates of earlier parts; @return with those of this one.
  int32_t add(int32_t own) {
    for (const auto& [name, set] : spec_.model.sets) {
      if (spec_.has(name))
        add_set(spec_.named(name), set);
      else
        say(fmt::format("part {}: set {} is left out: its displacements are no coordinates",
                        spec_.name, name));
    }
    append_nodes();
    for (PartCoordinate& one : spec_.coordinates)
      if (one.node < 0) one.own = own++;
    return own;
  }

 private:
  PartCoordinate& coordinate(const rom::DofSet& set, size_t k) {
    return spec_.coordinates[static_cast<size_t>(set.dofs[k])];
  }

  /// Three along orthogonal directions.
  static bool spans(const rom::DofSet& set, const std::vector<size_t>& entries) {
    if (entries.size() != 3) return false;
    Eigen::Matrix3d directions;
    for (int d = 0; d < 3; ++d)
      directions.col(d) = set.direction.row(static_cast<Eigen::Index>(entries[d]));
    return (directions.transpose() * directions).isIdentity(kOrthogonal);
  }

  /// The node that all of these coordinates belong to; -1: none has one yet; -2: neither.
  int32_t common_node(const rom::DofSet& set, const std::vector<size_t>& entries) {
    const int32_t node = coordinate(set, entries[0]).node;
    for (const size_t k : entries)
      if (coordinate(set, k).node != node) return -2;
    return node;
  }

  void assign(const rom::DofSet& set, const std::vector<size_t>& entries, int32_t node) {
    for (const size_t k : entries)
      coordinate(set, k) = {node, set.is_rotation[k] != 0,
                            set.direction.row(static_cast<Eigen::Index>(k)), -1};
  }

  int32_t new_node(const rom::DofSet& set, size_t entry) {
    added_.emplace_back(set.position.row(static_cast<Eigen::Index>(entry)));
    return static_cast<int32_t>(mesh_.nodes.rows() + added_.size()) - 1;
  }

  void append_nodes() {
    int32_t number = mesh_.node_ids.empty() ? 0 : std::ranges::max(mesh_.node_ids);
    Eigen::Index row = mesh_.nodes.rows();
    mesh_.nodes.conservativeResize(row + static_cast<Eigen::Index>(added_.size()), 3);
    for (const Eigen::Vector3d& position : added_) {
      mesh_.nodes.row(row++) = position;
      if (number > 0) mesh_.node_ids.push_back(++number);
    }
    for (const auto& [name, surface] : surfaces_)
      mesh::check_surface(surface, row, spec_.file.string() + ": " + name);
    mesh_.surfaces.merge(surfaces_);
    if (!surfaces_.empty()) refuse_name("surface", surfaces_.begin()->first);
  }

  /// The mesh's node of one node of the set, or -1.
  int32_t attach(const rom::DofSet& set, const NodeOfSet& found) {
    if (!spans(set, found.displacements)) return -1;
    int32_t node = common_node(set, found.displacements);
    if (node == -1) {
      node = new_node(set, found.displacements[0]);
      assign(set, found.displacements, node);
    }
    if (node < 0 || found.rotations.empty() || common_node(set, found.rotations) != -1) return node;
    const int missing = missing_axis(set, found.rotations);
    if (missing < 0 && !spans(set, found.rotations)) return node;
    if (missing >= 0) spec_.without[node] = 3 + missing;
    assign(set, found.rotations, node);
    mesh_.turning.push_back(node);
    return node;
  }

  /// The axis about which a node with rotations about two of x y z does not turn, or -1: of a flat
  /// sheet its normal.
  static int missing_axis(const rom::DofSet& set, const std::vector<size_t>& entries) {
    if (entries.size() != 2) return -1;
    Eigen::Vector3d turns = Eigen::Vector3d::Zero();
    for (const size_t k : entries)
      turns += set.direction.row(static_cast<Eigen::Index>(k)).cwiseAbs().transpose();
    int axis = -1;
    for (int d = 0; d < 3; ++d)
      if (turns(d) < kOrthogonal) axis = d;
    const bool both = axis >= 0 && std::abs(turns((axis + 1) % 3) - 1.0) < kOrthogonal &&
                      std::abs(turns((axis + 2) % 3) - 1.0) < kOrthogonal;
    return both ? axis : -1;
  }

  void add_set(const std::string& name, const rom::DofSet& set) {
    std::vector<int32_t> nodes;
    for (const NodeOfSet& one : split_nodes(set)) nodes.push_back(attach(set, one));
    const bool complete = std::ranges::all_of(nodes, [](int32_t node) { return node >= 0; });
    if (complete && !set.faces.empty() && nodes.size() == rom::nodes_of_set(set).size())
      add_surface(name, set, nodes);
    std::erase_if(nodes, [](int32_t node) { return node < 0; });
    std::ranges::sort(nodes);
    nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
    if (nodes.empty()) return;
    if (!mesh_.node_sets.emplace(name, nodes).second) refuse_name("node set", name);
  }

  void add_surface(const std::string& name, const rom::DofSet& set,
                   const std::vector<int32_t>& nodes) {
    mesh::Surface surface;
    for (const auto& [type, faces] : set.faces) {
      surface.faces.push_back(
          {mesh::face_type_named(type, spec_.file.string() + ": " + name), faces});
      for (int32_t& node : surface.faces.back().nodes.reshaped()) node = nodes[node];
    }
    surfaces_[name] = std::move(surface);
    if (set.sheet) spec_.sheets.push_back(name);
  }

  [[noreturn]] void refuse_name(const char* what, const std::string& name) const {
    spec_.source.fail("name", fmt::format("found the {} \"{}\" twice, expected different names: "
                                          "another name of the part, without keeps_names",
                                          what, name));
  }

  PartSpec& spec_;
  mesh::Mesh& mesh_;
  std::vector<Eigen::Vector3d> added_;  // nodes after those of the mesh
  std::map<std::string, mesh::Surface> surfaces_;
};

/// D = alpha K + beta M has one alpha and beta for all parts.
void check_damping(const recipe::File& file, const std::vector<PartSpec>& parts) {
  if (!file.damping.source.where().empty()) return;
  const PartSpec& first = parts.front();
  for (const PartSpec& part : parts)
    if (part.model.alpha != first.model.alpha || part.model.beta != first.model.beta)
      part.source.fail(
          "file",
          fmt::format("found damping alpha {:g} s, beta {:g} 1/s, and {:g}, {:g} of {}, expected "
                      "the same, or [damping] of the assembly",
                      part.model.alpha, part.model.beta, first.model.alpha, first.model.beta,
                      first.name));
}

}  // namespace

std::vector<PartSpec> attach_parts(const recipe::File& file, mesh::Mesh& mesh) {
  std::vector<PartSpec> parts;
  int32_t own = 0;
  for (const recipe::Part& part : file.parts) {
    parts.push_back(
        {part, where(part.source, "part " + part.name), read_part(part, file), {}, {}, {}});
    const Eigen::Index before = mesh.nodes.rows();
    own = Attachment(parts.back(), mesh).add(own);
    const rom::ReducedModel& model = parts.back().model;
    say(fmt::format("part {}: {} coordinates, {} nodes, valid to {:.0f} Hz", part.name,
                    model.size(), mesh.nodes.rows() - before, model.valid_to_hz));
  }
  std::ranges::sort(mesh.turning);
  if (!parts.empty()) check_damping(file, parts);
  return parts;
}

}  // namespace clatter::assembly
