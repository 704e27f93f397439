// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/substructures.hpp"

#include <algorithm>

namespace clatter::sparse {
namespace {

/// For every supernode: the first of its subtree, unknowns in the subtree, number of children.
struct Subtrees {
  std::vector<int32_t> lowest, unknowns, children;

  explicit Subtrees(const SupernodeTree& tree)
      : lowest(tree.lowest()), unknowns(lowest.size()), children(lowest.size()) {
    for (size_t s = 0; s < lowest.size(); ++s) {
      unknowns[s] += tree.columns(static_cast<int32_t>(s));
      if (tree.parent[s] < 0) continue;
      const auto p = static_cast<size_t>(tree.parent[s]);
      unknowns[p] += unknowns[s];
      ++children[p];
    }
  }
};

}  // namespace

std::vector<Substructure> partition(const SupernodeTree& tree, const PartitionLimits& limits) {
  const Subtrees trees(tree);
  const auto is_leaf = [&](size_t s) { return trees.unknowns[s] <= limits.leaf; };
  std::vector<Substructure> out;
  bool separator_last = false;  // the last substructure is a separator
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    const auto at = static_cast<size_t>(s);
    const int32_t parent = tree.parent[at];
    if (is_leaf(at)) {
      if (parent >= 0 && is_leaf(static_cast<size_t>(parent))) continue;  // inside a leaf
      out.push_back({trees.lowest[at], s + 1, trees.lowest[at], 0});
      separator_last = false;
      continue;
    }
    const bool follows = separator_last && out.back().to == s && tree.parent[s - 1] == s;
    if (follows) {
      const int32_t joined = tree.first[at + 1] - tree.first[out.back().from];
      if (trees.children[at] == 1 || joined <= limits.separator) {
        out.back().to = s + 1;
        out.back().lowest = trees.lowest[at];
        continue;
      }
    }
    out.push_back({s, s + 1, trees.lowest[at], 0});
    separator_last = true;
  }
  for (size_t k = 0; k < out.size(); ++k) {
    size_t first = k;
    while (first > 0 && out[first - 1].from >= out[k].lowest) --first;
    out[k].first_inside = static_cast<int32_t>(first);
  }
  return out;
}

}  // namespace clatter::sparse
