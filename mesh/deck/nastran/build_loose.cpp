// SPDX-License-Identifier: GPL-3.0-or-later
// What hangs on grids of ignored cells alone: masses, couplings, springs and loads that would make
// the model singular. All of it is refused together, or dropped when the user says so.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr const char* kLooseGrids = "LOOSE GRIDS";

/// Points in groups that relations join; all nodes of solids are one, entry 0.
class Groups {
 public:
  explicit Groups(const Model& model)
      : nodes_(model.node_map.node_count()), parent_(model.deck.points.size() + 1) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
  }
  void join(NodeIndex a, NodeIndex b) { parent_[root(entry(a))] = root(entry(b)); }
  bool on_solids(NodeIndex index) { return root(entry(index)) == root(0); }
  size_t of(NodeIndex index) { return root(entry(index)); }

 private:
  size_t entry(NodeIndex index) const {
    return index < nodes_ ? 0 : static_cast<size_t>(index - nodes_) + 1;
  }
  size_t root(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  NodeIndex nodes_;
  std::vector<size_t> parent_;
};

std::vector<NodeIndex> indices_of(const Rigid& rigid) {
  std::vector<NodeIndex> all = rigid.dependents;
  all.push_back(rigid.reference);
  return all;
}

std::vector<NodeIndex> indices_of(const Distributing& one) {
  std::vector<NodeIndex> all = {one.reference};
  for (const auto& term : one.terms)
    all.insert(all.end(), term.node_indices.begin(), term.node_indices.end());
  return all;
}

std::vector<NodeIndex> indices_of(const Beam& beam) { return {beam.ends[0], beam.ends[1]}; }

/// Equation, Spring, NodalMatrix.
template <class Relation>
std::vector<NodeIndex> indices_of(const Relation& relation) {
  std::vector<NodeIndex> all;
  for (const Equation::Term& term : relation.terms) all.push_back(term.node_index);
  return all;
}

class Loose {
 public:
  explicit Loose(Model& model) : model_(model), deck_(model.deck), groups_(model) {
    join_all(deck_.rigid);
    join_all(deck_.distributing);
    join_all(deck_.equations);
    join_all(deck_.springs);
    join_all(deck_.beams);
    join_all(deck_.matrices);
    const NodeIndex n = model.node_map.node_count();
    std::vector<size_t> lost;
    for (size_t p = 0; p < deck_.points.size(); ++p)
      if (model.is_lost(deck_.points[p].id))
        lost.push_back(groups_.of(n + static_cast<NodeIndex>(p)));
    std::sort(lost.begin(), lost.end());
    for (size_t p = 0; p < deck_.points.size(); ++p) {
      const NodeIndex index = n + static_cast<NodeIndex>(p);
      is_loose_.push_back(!groups_.on_solids(index) &&
                          std::binary_search(lost.begin(), lost.end(), groups_.of(index)));
    }
  }

  /// What hangs on loose points, as text; empty when there is nothing.
  std::string describe() const {
    std::vector<std::string> parts;
    const auto add = [&](int64_t count, const char* what) {
      if (count > 0) parts.push_back(fmt::format("{} {}", count, what));
    };
    double mass = 0.0;
    int64_t masses = 0;
    for (const Mass& one : deck_.masses) {
      if (!is_loose(one.node_index)) continue;
      mass += one.mass;
      ++masses;
    }
    if (masses > 0)
      parts.push_back(fmt::format("{} masses ({:g} in the deck's unit)", masses, mass));
    add(count(deck_.rigid), "rigid elements");
    add(count(deck_.distributing), "RBE3");
    add(count(deck_.springs), "springs");
    add(count(deck_.equations), "equations");
    add(count(deck_.beams), "bars");
    add(count(deck_.matrices), "matrices");
    int64_t loads = model_.lost_loads;
    for (const Step& step : deck_.steps)
      loads += std::count_if(step.forces.begin(), step.forces.end(),
                             [&](const Step::NodalForce& f) { return is_loose(f.node_index); });
    add(loads, "forces");
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  std::string first_where() const {
    for (const Mass& one : deck_.masses)
      if (is_loose(one.node_index)) return one.where;
    for (const Rigid& one : deck_.rigid)
      if (is_loose(one.reference)) return one.where;
    return model_.source.files().front();
  }

  void drop() {
    std::erase_if(deck_.masses, [&](const Mass& one) { return is_loose(one.node_index); });
    erase(deck_.rigid);
    erase(deck_.distributing);
    erase(deck_.equations);
    erase(deck_.springs);
    erase(deck_.beams);
    erase(deck_.matrices);
    drop_from(deck_.supports);
    drop_from(deck_.retained);
    for (Step& step : deck_.steps) {
      std::erase_if(step.forces, [&](const Step::NodalForce& f) { return is_loose(f.node_index); });
      drop_from(step.supports);
      drop_from(step.moved);
    }
    for (size_t p = 0; p < is_loose_.size(); ++p)
      if (is_loose_[p]) deck_.points[p].left_out = true;
  }

  /// Points of ignored cells define no mean: their RBE3 is that of the others. Returns how many.
  int64_t drop_members() {
    int64_t dropped = 0;
    for (Distributing& one : deck_.distributing)
      for (Distributing::Term& term : one.terms)
        dropped += static_cast<int64_t>(std::erase_if(term.node_indices, [&](NodeIndex index) {
          return is_point(index) && model_.is_lost(point(index).id);
        }));
    for (Distributing& one : deck_.distributing)
      std::erase_if(one.terms, [](const auto& term) { return term.node_indices.empty(); });
    std::vector<bool> used(deck_.points.size(), false);
    mark(used);
    for (size_t p = 0; p < used.size(); ++p)
      if (!used[p] && model_.is_lost(deck_.points[p].id)) deck_.points[p].left_out = true;
    return dropped;
  }

 private:
  bool is_point(NodeIndex index) const { return model_.node_map.is_point(index); }
  const Point& point(NodeIndex index) const {
    return deck_.points[index - model_.node_map.node_count()];
  }
  bool is_loose(NodeIndex index) const {
    return is_point(index) && is_loose_[index - model_.node_map.node_count()];
  }
  template <class Relations>
  void join_all(const Relations& relations) {
    for (const auto& one : relations) {
      const std::vector<NodeIndex> all = indices_of(one);
      for (const NodeIndex index : all) groups_.join(index, all.front());
    }
  }
  template <class Relation>
  bool hangs(const Relation& one) const {
    const std::vector<NodeIndex> all = indices_of(one);
    return !all.empty() && is_loose(all.front());
  }
  template <class Relations>
  int64_t count(const Relations& relations) const {
    return std::count_if(relations.begin(), relations.end(),
                         [&](const auto& one) { return hangs(one); });
  }
  template <class Relations>
  void erase(Relations& relations) {
    std::erase_if(relations, [&](const auto& one) { return hangs(one); });
  }
  void drop_from(std::vector<Support>& supports) {
    for (Support& support : supports)
      std::erase_if(support.node_indices, [&](NodeIndex index) { return is_loose(index); });
    std::erase_if(supports, [](const Support& support) { return support.node_indices.empty(); });
  }
  void mark(std::vector<bool>& used) const {
    const auto use = [&](NodeIndex index) {
      if (is_point(index)) used[index - model_.node_map.node_count()] = true;
    };
    const auto use_all = [&](const auto& relations) {
      for (const auto& one : relations)
        for (const NodeIndex index : indices_of(one)) use(index);
    };
    use_all(deck_.rigid);
    use_all(deck_.distributing);
    use_all(deck_.equations);
    use_all(deck_.springs);
    use_all(deck_.beams);
    use_all(deck_.matrices);
    for (const Mass& mass : deck_.masses) use(mass.node_index);
  }

  Model& model_;
  Deck& deck_;
  Groups groups_;
  std::vector<bool> is_loose_;  // by point
};

}  // namespace

void drop_loose(Model& model, Ignore& ignore) {
  if (model.raw.lost_grids.empty() || model.node_map.node_count() == 0 || model.refusals.any())
    return;
  Loose loose(model);
  const std::string what = loose.describe();
  if (!what.empty() && !ignore.skips(kLooseGrids)) {
    model.refusals.add(fmt::format(
        "{}: found what hangs on grids of ignored cells alone: {}; ignore = [\"{}\"] drops all of "
        "it, and its mass",
        loose.first_where(), what, kLooseGrids));
    return;
  }
  if (!what.empty())
    model.deck.notes.push_back(
        fmt::format("{}: left out with the ignored cells: {}", loose.first_where(), what));
  loose.drop();
  if (const int64_t dropped = loose.drop_members(); dropped > 0)
    model.deck.notes.push_back(fmt::format("{}: {} grids of ignored cells are left out of RBE3",
                                           model.source.files().front(), dropped));
}

}  // namespace clatter::mesh::deck::nastran
