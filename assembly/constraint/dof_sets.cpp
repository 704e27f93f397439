// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/dof_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

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
  std::map<std::string, rom::DofSet> sets;
  for (auto& [name, set] : by_id) {
    rom::DofSet found = numbered(std::move(set), elimination.reduced_of);
    if (!found.dofs.empty()) sets[name] = std::move(found);
  }
  return sets;
}

}  // namespace clatter::assembly
