// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/dof_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "assembly/constraint/coupling_members.hpp"

namespace clatter::assembly {
namespace {

/// The number in the deck of the mesh; 0: none.
int32_t number_in_deck(const PartData& part, NodeOrPoint owner) {
  int32_t node = owner.index;
  if (owner.is_point()) {
    const auto p = static_cast<size_t>(owner.point());
    if (part.recipe.points[p].number != 0) return part.recipe.points[p].number;
    node = part.numbers.points()[p].node;
  }
  return node < 0 || part.mesh.node_ids.empty() ? 0 : part.mesh.node_ids[node];
}

/// The faces between the nodes of a set that is kept with all displacements, by which other parts
/// can be tied to it: those of its surfaces, and boundary faces of the mesh between its node sets.
std::map<std::string, IndexMatrix> faces_between(const NodeSpec& spec,
                                                 const std::vector<KeptDof>& kept,
                                                 const PartData& part) {
  std::map<int32_t, std::pair<int32_t, int>> of_node;  // number in the set, displacements
  for (const KeptDof& dof : kept)
    if (!dof.owner.is_point())
      of_node.try_emplace(dof.owner.index, dof.number, 0).first->second.second += dof.direction < 3;
  std::erase_if(of_node, [](const auto& node) { return node.second.second < 3; });
  std::set<std::string> surfaces;
  for (const TermSpec& term : spec.terms)
    if (!term.selection.surface.empty()) surfaces.insert(term.selection.surface);
  if (surfaces.empty() && part.mesh.surfaces.contains("skin")) surfaces.insert("skin");
  mesh::SurfaceBuilder builder;
  std::set<std::vector<int32_t>> done;  // a face in two surfaces counts once
  for (const std::string& name : surfaces)
    for (const mesh::FaceBlock& block : part.mesh.surface(name).faces)
      for (const auto& face : block.nodes.rowwise()) {
        std::vector<int32_t> numbers;
        for (const int32_t node : face)
          if (const auto at = of_node.find(node); at != of_node.end())
            numbers.push_back(at->second.first);
        if (numbers.size() == static_cast<size_t>(face.size()) && done.insert(numbers).second)
          builder.add(block.type, numbers);
      }
  std::map<std::string, IndexMatrix> faces;
  for (const mesh::FaceBlock& block : builder.finish().faces)
    faces[std::string(mesh::traits(block.type).name)] = block.nodes;
  return faces;
}

/// Nodes are numbered as nodes_of_set() counts them: not where two lie at one position, nor where
/// the directions of one are in several terms.
bool numbered_by_position(const rom::DofSet& set, const std::vector<KeptDof>& kept) {
  const std::vector<int32_t> first = rom::nodes_of_set(set);
  for (size_t k = 0; k < first.size(); ++k) {
    const size_t end = k + 1 < first.size() ? static_cast<size_t>(first[k + 1]) : kept.size();
    for (size_t j = static_cast<size_t>(first[k]); j < end; ++j)
      if (kept[j].number != static_cast<int32_t>(k)) return false;
  }
  return true;
}

/// The DoFs of a [[nodes]] or [[sensor]], as ids.
rom::DofSet kept_set(const NodeSpec& spec, const std::vector<KeptDof>& kept,
                     const std::vector<int32_t>& ids, const PartData& part) {
  rom::DofSet set;
  set.kind = spec.kind;
  const auto rows = static_cast<Eigen::Index>(kept.size());
  set.position.resize(rows, 3);
  set.direction = Eigen::MatrixXd::Zero(rows, 3);
  const bool single = std::ranges::all_of(kept, [](const KeptDof& dof) { return dof.number == 0; });
  for (const KeptDof& dof : kept) {
    const auto r = static_cast<Eigen::Index>(set.dofs.size());
    set.dofs.push_back(ids[r]);
    set.position.row(r) = part.numbers.position(dof.owner).transpose();
    set.direction.row(r) = dof.along.transpose();
    set.components.push_back(dof.turned ? dof.direction + 1 : 0);
    set.is_rotation.push_back(dof.direction < 3 ? 0 : 1);
    set.node_ids.push_back(number_in_deck(part, dof.owner));
    const char* axis = kDofNames[dof.direction];
    set.labels.push_back(single ? fmt::format("{}.{}", spec.name, axis)
                                : fmt::format("{}[{}].{}", spec.name, dof.number, axis));
  }
  if (std::ranges::all_of(set.node_ids, [](int32_t number) { return number == 0; }))
    set.node_ids.clear();
  if (std::ranges::all_of(set.components, [](int32_t component) { return component == 0; }))
    set.components.clear();
  if (!spec.near && numbered_by_position(set, kept)) set.faces = faces_between(spec, kept, part);
  set.sheet = !set.faces.empty() && std::ranges::all_of(kept, [&](const KeptDof& dof) {
    return !dof.owner.is_point() && part.numbers.rotation_of(dof.owner.index) >= 0;
  });
  return set;
}

/// Six DoFs of a reference node or point, as ids. @param number of the node in the deck; 0: none.
rom::DofSet six_dofs(const std::string& name, const std::string& kind,
                     const ReferenceDofs& reference, int32_t number = 0) {
  rom::DofSet set = reference_set(name, kind, reference.position, {0, 1, 2, 3, 4, 5});
  set.dofs.assign(reference.ids.begin(), reference.ids.end());
  if (number != 0) set.node_ids.assign(set.dofs.size(), number);
  return set;
}

/// A set of a reduced part, as ids: of its nodes those along the axes of the assembly.
rom::DofSet set_of_part(const rom::DofSet& given, const PartSpec& spec, const DofNumbers& numbers) {
  rom::DofSet set;
  set.kind = given.kind;
  std::vector<Eigen::Index> entries;
  std::vector<Eigen::Vector3d> along;
  const auto add = [&](size_t k, int32_t id, const Eigen::Vector3d& direction, std::string label) {
    entries.push_back(static_cast<Eigen::Index>(k));
    along.push_back(direction);
    set.dofs.push_back(id);
    set.labels.push_back(spec.named(label));
    set.is_rotation.push_back(given.is_rotation[k]);
  };
  std::set<std::pair<int32_t, bool>> done;  // displacements or rotations of a node
  bool complete = true;
  for (size_t k = 0; k < given.dofs.size(); ++k) {
    const PartCoordinate& one = spec.coordinates[static_cast<size_t>(given.dofs[k])];
    complete = complete && one.node >= 0;
    if (one.node < 0) {
      add(k, static_cast<int32_t>(numbers.first_own()) + one.own,
          given.direction.row(static_cast<Eigen::Index>(k)), given.labels[k]);
    } else if (done.emplace(one.node, one.is_rotation).second) {
      const std::string name = given.labels[k].substr(0, given.labels[k].rfind('.'));
      for (int d = 0; d < 3; ++d) {
        const int direction = d + (one.is_rotation ? 3 : 0);
        if (const auto none = spec.without.find(one.node);
            none != spec.without.end() && none->second == direction)
          continue;
        add(k, numbers.of(NodeOrPoint::of_node(one.node), direction), Eigen::Vector3d::Unit(d),
            fmt::format("{}.{}", name, kDofNames[direction]));
      }
    }
  }
  set.position = given.position(entries, Eigen::all);
  set.direction.resize(set.position.rows(), 3);
  for (size_t k = 0; k < along.size(); ++k)
    set.direction.row(static_cast<Eigen::Index>(k)) = along[k].transpose();
  if (complete) {
    set.faces = given.faces;
    set.sheet = given.sheet;
  }
  return set;
}

/// The same set with coordinates instead of ids, without ids that are no coordinates.
rom::DofSet numbered(rom::DofSet set, const std::vector<int32_t>& reduced_of) {
  std::vector<Eigen::Index> rows;
  for (size_t k = 0; k < set.dofs.size(); ++k) {
    const int32_t reduced = reduced_of[set.dofs[k]];
    if (reduced < 0) continue;
    const size_t to = rows.size();
    rows.push_back(static_cast<Eigen::Index>(k));
    set.dofs[to] = reduced;
    set.labels[to] = set.labels[k];
    set.is_rotation[to] = set.is_rotation[k];
    if (!set.node_ids.empty()) set.node_ids[to] = set.node_ids[k];
    if (!set.components.empty()) set.components[to] = set.components[k];
  }
  if (rows.size() != set.dofs.size()) set.faces.clear();
  set.dofs.resize(rows.size());
  set.labels.resize(rows.size());
  set.is_rotation.resize(rows.size());
  if (!set.node_ids.empty()) set.node_ids.resize(rows.size());
  if (!set.components.empty()) set.components.resize(rows.size());
  set.position = set.position(rows, Eigen::all).eval();
  set.direction = set.direction(rows, Eigen::all).eval();
  return set;
}

}  // namespace

std::map<std::string, rom::DofSet> sets_of_coordinates(
    const PartData& part, const KeptRelations& kept,
    const std::map<std::string, rom::DofSet>& generalised, const Elimination& elimination) {
  const Relations& relations = kept.relations;
  std::map<std::string, rom::DofSet> by_id = generalised;
  by_id.insert(relations.bolts.begin(), relations.bolts.end());
  for (const CouplingSpec& spec : part.recipe.couplings)
    if (spec.rigid && spec.on_point.empty())
      by_id[spec.name] = six_dofs(spec.name, spec.kind, relations.references.at(spec.name));
  for (size_t s = 0; s < part.recipe.nodes.size(); ++s) {
    const NodeSpec& spec = part.recipe.nodes[s];
    by_id[spec.name] = kept_set(spec, relations.kept[s], kept.ids[s], part);
  }
  for (size_t p = 0; p < part.recipe.points.size(); ++p) {
    const std::string& name = part.recipe.points[p].point.name;
    by_id[name] = six_dofs(name, "node", point_dofs(part.numbers, static_cast<int32_t>(p)),
                           part.recipe.points[p].number);
  }
  for (const PartSpec& spec : part.recipe.parts)
    for (const auto& [name, set] : spec.model.sets)
      if (spec.has(name)) by_id[spec.named(name)] = set_of_part(set, spec, part.numbers);
  std::map<std::string, rom::DofSet> sets;
  for (auto& [name, set] : by_id) {
    rom::DofSet found = numbered(std::move(set), elimination.reduced_of);
    if (!found.dofs.empty()) sets[name] = std::move(found);
  }
  return sets;
}

}  // namespace clatter::assembly
