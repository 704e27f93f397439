// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/tree_schedule.hpp"

#include <algorithm>
#include <queue>
#include <utility>

namespace clatter::sparse {

TreeSchedule schedule(const SupernodeTree& tree, int threads, std::vector<double> work,
                      double share) {
  const size_t n = work.size();
  TreeSchedule out;
  out.lowest = tree.lowest();
  for (size_t s = 0; s < n; ++s)
    if (tree.parent[s] >= 0) work[tree.parent[s]] += work[s];
  const auto lighter = [&](int32_t a, int32_t b) { return work[a] < work[b]; };
  std::priority_queue<int32_t, std::vector<int32_t>, decltype(lighter)> heaviest(lighter);
  double total = 0.0;
  for (size_t s = 0; s < n; ++s) {
    if (tree.parent[s] >= 0) continue;
    heaviest.push(static_cast<int32_t>(s));
    total += work[s];
  }
  const double limit = threads > 1 ? share * total / threads : -1.0;
  const std::vector<std::vector<int32_t>> children = tree.children();
  while (!heaviest.empty() && work[heaviest.top()] > limit) {
    const int32_t s = heaviest.top();
    heaviest.pop();
    out.top.push_back(s);
    for (const int32_t child : children[s]) heaviest.push(child);
  }
  std::sort(out.top.begin(), out.top.end());
  for (; !heaviest.empty(); heaviest.pop()) out.subtrees.push_back(heaviest.top());
  return out;
}

TreeSchedule schedule(const SupernodeTree& tree, int threads) {
  constexpr double kShare = 0.1;
  std::vector<double> flops(static_cast<size_t>(tree.supernodes()));
  for (size_t s = 0; s < flops.size(); ++s) flops[s] = tree.flops(static_cast<int32_t>(s));
  return schedule(tree, threads, std::move(flops), kShare);
}

}  // namespace clatter::sparse
