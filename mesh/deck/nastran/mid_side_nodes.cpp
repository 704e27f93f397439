// SPDX-License-Identifier: GPL-3.0-or-later
// Cells with only some mid-side nodes, as between linear and quadratic cells. Without the mid-side
// node of an edge the cell's displacement is linear along it, as with a mid-side node whose
// displacement is the mean of the edge's ends: such a node is added and recorded as hanging.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

/// Rows of the two ends, the lower one first, to the mid-side node made for them.
using MidSideNodes = std::map<std::pair<int32_t, int32_t>, int32_t>;

class Completer {
 public:
  Completer(Model& model, std::vector<int32_t>& mesh_node) : model_(model), mesh_node_(mesh_node) {}

  void complete(RawBlock& block) {
    const CellTraits& cell = traits(block.type);
    const auto per_cell = static_cast<size_t>(cell.nodes);
    for (size_t first = 0; cell.order == 2 && first < block.nodes.size(); first += per_cell) {
      // In an order that is the same for a left-handed cell and for the one that it becomes.
      std::multimap<std::pair<int32_t, int32_t>, size_t> missing;  // two of a collapsed face
      for (size_t e = 0; e < cell.edges.size(); ++e) {
        const size_t at = first + static_cast<size_t>(cell.corners) + e;
        if (block.nodes[at] != kNoRow) continue;
        const int32_t i = block.nodes[first + static_cast<size_t>(cell.edges[e][0])],
                      j = block.nodes[first + static_cast<size_t>(cell.edges[e][1])];
        if (i == j)
          block.nodes[at] = i;  // an edge without length, of repeated corners
        else
          missing.emplace(std::minmax(i, j), at);
      }
      for (const auto& [ends, at] : missing) block.nodes[at] = between(ends.first, ends.second);
    }
  }

  std::vector<int32_t> hanging_rows() const { return hanging_rows_; }

 private:
  int32_t between(int32_t a, int32_t b) {
    const auto [at, fresh] = mid_side_nodes_.emplace(std::minmax(a, b), 0);
    if (fresh) at->second = add(static_cast<size_t>(a), static_cast<size_t>(b));
    return at->second;
  }

  int32_t add(size_t a, size_t b) {
    Grids& grids = model_.raw.grids;
    if (next_ == 0)
      next_ = std::max(*std::max_element(grids.ids.begin(), grids.ids.end()),
                       model_.raw.first_hanging - 1);
    if (next_ == std::numeric_limits<int32_t>::max())
      model_.source.fail(grids.origins[a], "found no free number above the largest GRID");
    const auto row = static_cast<int32_t>(grids.size());
    std::array<double, 3> at{};
    for (size_t k = 0; k < 3; ++k) at[k] = 0.5 * (grids.at[a][k] + grids.at[b][k]);
    grids.ids.push_back(++next_);
    grids.at.push_back(at);
    grids.origins.push_back(grids.origins[a]);
    mesh_node_.push_back(0);
    hanging_rows_.push_back(row);
    return row;
  }

  Model& model_;
  std::vector<int32_t>& mesh_node_;
  std::vector<int32_t> hanging_rows_;
  MidSideNodes mid_side_nodes_;
  int32_t next_ = 0;  // last assigned number
};

}  // namespace

std::vector<int32_t> complete_cells(Model& model, std::vector<int32_t>& mesh_node) {
  Completer completer(model, mesh_node);
  for (RawBlock& block : model.raw.blocks) completer.complete(block);
  return completer.hanging_rows();
}

}  // namespace clatter::mesh::deck::nastran
