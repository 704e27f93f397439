// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/model.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::mesh::deck::nastran {
namespace {

// Limit of the effort for lists: about a second of visits, or half a gigabyte of entries.
constexpr int64_t kMostEffort = 500'000'000, kMostEffortPerGrid = 2000;

// Blank fields of GRID get GRDSET's values.
void fill_defaults(RawDeck& raw) {
  Grids& grids = raw.grids;
  const auto fill = [&](auto& column, auto blank, auto zero, auto value) {
    if (value != blank) column.resize(grids.size(), blank);
    for (auto& entry : column) entry = entry == blank ? value : entry == zero ? blank : entry;
  };
  fill(grids.cp, kBlank, kZero, raw.defaults.cp);
  fill(grids.cd, kBlank, kZero, raw.defaults.cd);
  fill(grids.held, DofMask{0}, kNoneHeld, raw.defaults.held);
}

// Decks that include the same grids twice are common; they must agree.
IdIndex grid_index(const Grids& grids, const Source& source) {
  IdIndex index(grids.ids);
  for (const auto& [a, b] : index.duplicates()) {
    const auto i = static_cast<size_t>(a), j = static_cast<size_t>(b);
    const bool same = grids.at[i] == grids.at[j] &&
                      column_at(grids.cp, i) == column_at(grids.cp, j) &&
                      column_at(grids.cd, i) == column_at(grids.cd, j) &&
                      column_at(grids.held, i) == column_at(grids.held, j);
    if (same) continue;
    source.fail(grids.origins[j], fmt::format("GRID {}: found another one with this number at {}",
                                              grids.ids[j], source.where(grids.origins[i])));
  }
  return index;
}

RawDeck with_defaults(RawDeck raw) {
  fill_defaults(raw);
  return raw;
}

}  // namespace

Model::Model(const Source& deck_source, RawDeck cards, Refusals& all_refusals)
    : source(deck_source),
      refusals(all_refusals),
      raw(with_defaults(std::move(cards))),
      grids(grid_index(raw.grids, source)),
      systems(raw, grids, source),
      index_of_row(raw.grids.size(), -1) {
  for (size_t row = 0; row < raw.grids.cp.size(); ++row) {
    Eigen::Map<Eigen::Vector3d> at(raw.grids.at[row].data());
    at = systems.to_basic(raw.grids.cp[row], at, raw.grids.origins[row]);
  }
}

size_t Model::row_of(int32_t grid, Origin origin) const {
  const int32_t row = grids.find(grid);
  if (row < 0) source.fail(origin, fmt::format("found no GRID {}", grid));
  return static_cast<size_t>(row);
}

NodeIndex Model::node_index_of(size_t row, Origin origin, bool make_points) {
  NodeIndex& node_index = index_of_row[row];
  if (node_index >= 0 || !make_points) return node_index;
  spend(16, origin);
  node_index = node_count + static_cast<NodeIndex>(deck.points.size());
  const auto& at = raw.grids.at[row];
  deck.points.push_back({raw.grids.ids[row], {at[0], at[1], at[2]}});
  row_of_index_.push_back(static_cast<int32_t>(row));
  return node_index;
}

NodeIndex Model::require(int32_t grid, Origin origin) {
  return node_index_of(row_of(grid, origin), origin, true);
}

NodeIndex Model::find(int32_t grid, Origin origin) const {
  return index_of_row[row_of(grid, origin)];
}

std::vector<NodeIndex> Model::node_indices(const IdList& list, Origin origin, bool make_points) {
  std::vector<NodeIndex> out;
  for_each_grid(list, origin, [&](size_t row) {
    const NodeIndex node_index = node_index_of(row, origin, make_points);
    if (node_index < 0) return;
    spend(16, origin);
    out.push_back(node_index);
  });
  return out;
}

Eigen::Vector3d Model::position(NodeIndex node_index) const {
  if (is_point(node_index)) return deck.points[static_cast<size_t>(node_index - node_count)].at;
  return deck.mesh.nodes.row(node_index).transpose();
}

int32_t Model::displacement_system(NodeIndex node_index) const {
  return column_at(raw.grids.cd,
                   static_cast<size_t>(row_of_index_[static_cast<size_t>(node_index)]));
}

std::string Model::system_name(int32_t system, Origin origin) {
  if (system == 0) return {};
  const System& found = systems.get(system, origin);
  deck.systems[found.name] = found;
  return found.name;
}

void Model::spend(int64_t effort, Origin origin) {
  effort_ += effort;
  const auto grid_count = static_cast<int64_t>(raw.grids.size());
  if (effort_ > std::max(kMostEffort, kMostEffortPerGrid * grid_count)) {
    source.fail(origin, "the lists of this deck repeat the same grids too often");
  }
}

void add_term(std::vector<Equation::Term>& terms, NodeIndex node_index, int direction,
              double coefficient) {
  if (coefficient != 0.0) terms.push_back({node_index, direction, coefficient});
}

void count_unused(Model& model) {
  const auto unused = std::count(model.index_of_row.begin(), model.index_of_row.end(), -1);
  if (unused > 0) model.deck.ignored["GRID (of no solid and no coupling)"] = unused;
}

}  // namespace clatter::mesh::deck::nastran
