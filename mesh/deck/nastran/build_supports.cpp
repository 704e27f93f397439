// SPDX-License-Identifier: GPL-3.0-or-later
// SPC, SPC1, SPCADD, permanent constraints of GRID, ASET and BSET: directions are those of each
// grid's displacement system. Nodes of solids have no rotations; grids without a node index have no
// DoFs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/nastran/sets.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

struct Held {
  NodeIndex node_index = 0;
  DofMask dofs = 0;
  Origin origin = 0;
  double value = 0.0;
};

class Holder {
 public:
  Holder(Model& model, std::string name) : model_(model), name_(std::move(name)) {}

  void add(const RawHold& hold) {
    model_.for_each_grid(hold.grids, hold.origin, [&](size_t row) {
      add_node(model_.index_of_row[row], hold.dofs, hold.value, hold.origin);
    });
  }

  void add_node(NodeIndex node_index, DofMask dofs, double value, Origin origin) {
    if (node_index < 0) return;
    if (model_.is_node(node_index)) dofs = dofs & kTranslations;
    if (dofs == 0) return;
    model_.spend(16, origin);
    held_.push_back({node_index, dofs, origin, value});
  }

  // One Support for each value, set of directions and system.
  std::vector<Support> supports() {
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

 private:
  // The supports of one node, entries [begin, end).
  void merge(size_t begin, size_t end) {
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
    const int32_t system = model_.displacement_system(first.node_index);
    for (const auto& [value, dofs] : by_value) {
      auto [at, fresh] = groups_.try_emplace({system, value, dofs});
      Support& support = at->second;
      if (fresh) {
        support.where = model_.where(first.origin);
        support.dofs = dofs;
        support.value = value;
        support.system = model_.system_name(system, first.origin);
      }
      support.node_indices.push_back(first.node_index);
    }
  }

  [[noreturn]] void refuse(const Held& held, double other) const {
    model_.source.fail(held.origin, fmt::format("{}: found {} and {} as displacement of one "
                                                "direction of a grid",
                                                name_, held.value, other));
  }

  Model& model_;
  std::string name_;
  std::vector<Held> held_;
  std::map<std::tuple<int32_t, double, DofMask>, Support> groups_;
};

}  // namespace

std::vector<Support> supports_of(Model& model, int32_t set, Origin origin) {
  Holder holder(model, fmt::format("spc_{}", set));
  for (const int32_t part :
       members_of(model, "SPC", set, model.bulk.spc, model.bulk.spc_sums, origin)) {
    for (const RawHold& hold : model.bulk.spc.at(part)) holder.add(hold);
  }
  return holder.supports();
}

void build_supports(Model& model) {
  const auto append = [](std::vector<Support>& to, std::vector<Support> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  Holder permanent(model, "ps");
  for (size_t row = 0; row < model.bulk.grids.held.size(); ++row) {
    permanent.add_node(model.index_of_row[row], model.bulk.grids.held[row], 0.0,
                       model.bulk.grids.origins[row]);
  }
  append(model.deck.supports, permanent.supports());

  // Sets selected by all subcases belong to the model, others to their steps (build_steps).
  const Control& control = model.bulk.control;
  int32_t set = 0;
  Origin origin = 0;
  if (control.has_cases) {
    const Subcase& first = control.subcases.front();
    const bool same =
        std::all_of(control.subcases.begin(), control.subcases.end(),
                    [&](const Subcase& subcase) { return subcase.choice.spc == first.choice.spc; });
    if (same) set = first.choice.spc;
    origin = first.origin;
  } else {
    set = only_set(model, "SPC", model.bulk.spc, model.bulk.spc_sums);
  }
  if (set != 0) append(model.deck.supports, supports_of(model, set, origin));

  Holder retained(model, "aset");
  for (const RawHold& hold : model.bulk.retained) retained.add(hold);
  append(model.deck.retained, retained.supports());
}

}  // namespace clatter::mesh::deck::nastran
