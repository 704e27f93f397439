// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/supports.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::mesh::deck::nastran {

void Supports::read(const RawHold& hold) {
  model_.for_each_grid(hold.grids, hold.origin, [&](size_t row) {
    DofMask dofs = hold.dofs;
    if (const int32_t grid = model_.raw.grids.ids[row];
        dofs == 0 || model_.raw.scalar_points.contains(grid))
      dofs = static_cast<DofMask>(
          1 << model_.direction_at(grid, dofs == 0 ? kScalar : 0, hold.origin));
    if (model_.node_map.find(row) == NodeMap::kNone) ++unused_;
    add_node(model_.node_map.find(row), dofs, hold.value, hold.origin);
  });
}

void Supports::add_node(NodeIndex node_index, DofMask dofs, double value, Origin origin) {
  if (node_index < 0) return;
  if (!model_.node_map.turns(node_index)) dofs = dofs & kTranslations;
  if (dofs == 0) return;
  model_.spend(16, origin);
  held_.push_back({node_index, dofs, origin, value});
}

std::vector<Support> Supports::list() {
  std::stable_sort(held_.begin(), held_.end(),
                   [](const Held& a, const Held& b) { return a.node_index < b.node_index; });
  for (size_t i = 0; i < held_.size();) {
    size_t end = i;
    while (end < held_.size() && held_[end].node_index == held_[i].node_index) ++end;
    merge(i, end);
    i = end;
  }
  std::vector<Support> out;
  for (auto& [key, support] : groups_) out.push_back(std::move(support));
  for (size_t i = 0; i < out.size(); ++i) {
    out[i].name = out.size() == 1 ? name_ : fmt::format("{}_{}", name_, i + 1);
  }
  return out;
}

// The supports of one node, entries [begin, end).
void Supports::merge(size_t begin, size_t end) {
  std::map<double, DofMask> by_value;
  for (size_t i = begin; i < end; ++i) {
    const Held& held = held_[i];
    for (const auto& [value, dofs] : by_value) {
      if (value != held.value && (dofs & held.dofs) != 0) refuse(held, value);
    }
    DofMask& dofs = by_value[held.value];
    dofs = static_cast<DofMask>(dofs | held.dofs);
  }
  const Held& first = held_[begin];
  const int32_t system = model_.node_map.displacement_system(first.node_index);
  const auto add = [&](double value, DofMask dofs) {
    if (dofs == 0) return;
    auto [at, fresh] = groups_.try_emplace({system, value, dofs});
    Support& support = at->second;
    if (fresh) {
      support.where = model_.source.where(first.origin);
      support.dofs = dofs;
      support.value = value;
      support.system = model_.system_name(system, first.origin);
    }
    support.node_indices.push_back(first.node_index);
  };
  for (const auto& [value, dofs] : by_value) {
    // A value is a length or an angle.
    const DofMask shifts = value == 0.0 ? dofs : static_cast<DofMask>(dofs & kTranslations);
    add(value, shifts);
    add(value, static_cast<DofMask>(dofs & ~shifts));
  }
}

void Supports::refuse(const Held& held, double other) const {
  model_.source.fail(held.origin, fmt::format("{}: found {} and {} as displacement of one "
                                              "direction of a grid",
                                              name_, held.value, other));
}

}  // namespace clatter::mesh::deck::nastran
