// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/orient_shells.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace clatter::mesh {
namespace {

/// An edge of a cell; both cells run along it in opposite senses where their sides agree.
struct ShellEdge {
  int32_t low, high;  // nodes
  int32_t cell;
  bool ascending;

  bool same_nodes(const ShellEdge& other) const { return low == other.low && high == other.high; }
};

struct Neighbour {
  int32_t cell = -1;
  bool agrees = true;
};

using Neighbours = std::vector<std::array<Neighbour, 4>>;  // by cell, across each of its edges

std::vector<ShellEdge> edges_of(const std::vector<ShellBlock>& shells, int32_t& cells) {
  std::vector<ShellEdge> edges;
  for (const ShellBlock& block : shells)
    for (Eigen::Index row = 0; row < block.nodes.rows(); ++row, ++cells)
      for (Eigen::Index i = 0, n = traits(block.type).corners; i < n; ++i) {
        const int32_t a = block.nodes(row, i), b = block.nodes(row, (i + 1) % n);
        edges.push_back({std::min(a, b), std::max(a, b), cells, a < b});
      }
  std::sort(edges.begin(), edges.end(), [](const ShellEdge& a, const ShellEdge& b) {
    return std::tie(a.low, a.high, a.cell) < std::tie(b.low, b.high, b.cell);
  });
  return edges;
}

void add_neighbour(std::array<Neighbour, 4>& of, const Neighbour& one) {
  *std::ranges::find_if(of, [](const Neighbour& free) { return free.cell < 0; }) = one;
}

Neighbours neighbours_of(const std::vector<ShellBlock>& shells) {
  int32_t cells = 0;
  const std::vector<ShellEdge> edges = edges_of(shells, cells);
  Neighbours all(static_cast<size_t>(cells));
  for (size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].same_nodes(edges[i])) ++end;
    if (end != i + 2) continue;
    const ShellEdge &a = edges[i], &b = edges[i + 1];
    const bool agrees = a.ascending != b.ascending;
    add_neighbour(all[static_cast<size_t>(a.cell)], {b.cell, agrees});
    add_neighbour(all[static_cast<size_t>(b.cell)], {a.cell, agrees});
  }
  return all;
}

/// Which cells to turn.
class Sides {
 public:
  Sides(const Neighbours& all, const std::vector<bool>& kept)
      : all_(all), kept_(kept), reached_(all.size()), turned_(all.size()) {}

  std::vector<bool> find() {
    for (size_t cell = 0; cell < all_.size(); ++cell)
      if (!reached_[cell]) settle(static_cast<int32_t>(cell));
    return std::move(turned_);
  }

 private:
  /// All cells that hang together with the first one, breadth first.
  void settle(int32_t first) {
    std::vector<int32_t> sheet = {first};
    reached_[static_cast<size_t>(first)] = true;
    bool has_sides = true;
    for (size_t i = 0; i < sheet.size(); ++i)
      for (const Neighbour& next : all_[static_cast<size_t>(sheet[i])]) {
        if (next.cell < 0) continue;
        const auto at = static_cast<size_t>(next.cell);
        const bool turn = turned_[static_cast<size_t>(sheet[i])] == next.agrees;
        if (reached_[at]) {
          has_sides = has_sides && turned_[at] == turn;
          continue;
        }
        reached_[at] = true;
        turned_[at] = turn;
        sheet.push_back(next.cell);
      }
    const auto count = [&](bool kept, bool turned) {
      return std::ranges::count_if(sheet, [&](int32_t cell) {
        const auto at = static_cast<size_t>(cell);
        return (kept_[at] || !kept) && turned_[at] == turned;
      });
    };
    const auto kept = count(true, false), against = count(true, true);
    has_sides = has_sides && (kept == 0 || against == 0);
    const bool most = kept + against > 0 ? against > 0 : count(false, true) > count(false, false);
    for (const int32_t cell : sheet) {
      const auto at = static_cast<size_t>(cell);
      turned_[at] = has_sides && turned_[at] != most;
    }
  }

  const Neighbours& all_;
  const std::vector<bool>& kept_;
  std::vector<bool> reached_, turned_;
};

void turn(ShellBlock& block, Eigen::Index row) {
  turn_over(block.type, block.nodes.row(row));
  if (block.thickness.size() > 0) turn_over(block.type, block.thickness.row(row));
  if (block.offset.size() > 0) block.offset(row) = -block.offset(row);
}

}  // namespace

int64_t orient_shells(std::vector<ShellBlock>& shells, const std::vector<bool>& keep) {
  std::vector<bool> kept;
  for (size_t b = 0; b < shells.size(); ++b)
    kept.insert(kept.end(), static_cast<size_t>(shells[b].nodes.rows()), !keep.empty() && keep[b]);
  const Neighbours all = neighbours_of(shells);
  const std::vector<bool> turned = Sides(all, kept).find();
  int64_t count = 0;
  size_t cell = 0;
  for (ShellBlock& block : shells) {
    for (Eigen::Index row = 0; row < block.nodes.rows(); ++row, ++cell) {
      if (!turned[cell]) continue;
      turn(block, row);
      ++count;
    }
  }
  return count;
}

}  // namespace clatter::mesh
