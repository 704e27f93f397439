// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/supernode_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/sparse/factor/cholmod_analysis.hpp"

namespace clatter::sparse {
namespace {

void find_parents(SupernodeTree& tree) {
  const std::vector<int32_t> owner = tree.owners();
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    if (tree.below(s) == 0) continue;
    const int32_t row = tree.rows_of(s)[tree.columns(s)];
    tree.parent[s] = owner[row];
  }
}

/// Appends to each front the boundary unknowns coupled to its subtree.
void add_boundary_rows(const SparseMatrix& coupling, SupernodeTree& tree) {
  tree.boundary = static_cast<int32_t>(coupling.cols());
  const std::vector<int32_t> index = tree.inverse_order(), owner = tree.owners();
  std::vector<std::vector<int32_t>> touched(tree.parent.size());
  for (int32_t b = 0; b < tree.boundary; ++b) {
    for (SparseMatrix::InnerIterator it(coupling, b); it; ++it) {
      auto& list = touched[owner[index[it.row()]]];
      if (list.empty() || list.back() != b) list.push_back(b);
    }
  }
  std::vector<int64_t> starts{0};
  std::vector<int32_t> rows;
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    auto& list = touched[s];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    rows.insert(rows.end(), tree.rows_of(s), tree.rows_of(s) + tree.height(s));
    for (const int32_t b : list) rows.push_back(tree.size + b);
    starts.push_back(static_cast<int64_t>(rows.size()));
    const int32_t parent = tree.parent[s];
    if (parent < 0) continue;
    auto& above = touched[parent];
    above.insert(above.end(), list.begin(), list.end());
    std::vector<int32_t>().swap(list);
  }
  tree.row_start.swap(starts);
  tree.rows.swap(rows);
}

}  // namespace

int32_t SupernodeTree::rows_before(int32_t s, int32_t index) const {
  const int32_t* begin = rows_of(s) + columns(s);
  return static_cast<int32_t>(std::lower_bound(begin, begin + below(s), index) - begin);
}

double SupernodeTree::flops(int32_t s) const {
  const double p = columns(s), q = below(s);
  return p * p * p / 3.0 + p * p * q + p * q * q;
}

double SupernodeTree::flops() const {
  double sum = 0.0;
  for (int32_t s = 0; s < supernodes(); ++s) sum += flops(s);
  return sum;
}

int64_t SupernodeTree::stack_entries() const {
  std::vector<int64_t> of_children(parent.size(), 0);
  int64_t now = 0, peak = 0;
  for (int32_t s = 0; s < supernodes(); ++s) {
    const int64_t own = int64_t{below(s)} * below(s);
    peak = std::max(peak, now + own);
    now += own - of_children[at(s)];
    if (parent[at(s)] >= 0) of_children[at(parent[at(s)])] += own;
  }
  return peak;
}

std::vector<std::vector<int32_t>> SupernodeTree::children() const {
  std::vector<std::vector<int32_t>> out(parent.size());
  for (int32_t s = 0; s < supernodes(); ++s)
    if (parent[at(s)] >= 0) out[at(parent[at(s)])].push_back(s);
  return out;
}

std::vector<int32_t> SupernodeTree::lowest() const {
  std::vector<int32_t> out(parent.size());
  std::iota(out.begin(), out.end(), 0);
  for (size_t s = 0; s < out.size(); ++s)
    if (parent[s] >= 0) out[at(parent[s])] = std::min(out[at(parent[s])], out[s]);
  return out;
}

std::vector<int32_t> SupernodeTree::owners() const {
  std::vector<int32_t> out(at(size));
  for (int32_t s = 0; s < supernodes(); ++s)
    std::fill(out.begin() + first[at(s)], out.begin() + first[at(s) + 1], s);
  return out;
}

std::vector<int32_t> SupernodeTree::inverse_order() const {
  std::vector<int32_t> out(order.size());
  for (size_t j = 0; j < order.size(); ++j) out[at(order[j])] = static_cast<int32_t>(j);
  return out;
}

SupernodeTree analyse_tree(const SparseMatrix& lower, const TreeOptions& options,
                           const SparseMatrix& coupling) {
  const Stopwatch clock;
  SupernodeTree tree;
  tree.size = static_cast<int32_t>(lower.cols());
  std::vector<int64_t> order(options.permutation.begin(), options.permutation.end());
  tree.ordering = "given";
  if (order.empty()) {
    const FillOrder found = fill_reducing_order(lower, options.ordering);
    order.assign(found.order.begin(), found.order.end());
    tree.ordering = ordering_name(found.method);
  }
  if (order.size() != static_cast<size_t>(tree.size))
    throw NumericsError(fmt::format("ordering: found a permutation of {} unknowns, expected {}",
                                    order.size(), tree.size));
  find_supernodes(lower, order, options.merged, tree);
  find_parents(tree);
  if (coupling.cols() > 0) add_boundary_rows(coupling, tree);
  tree.panel_start.assign(1, 0);
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    tree.panel_start.push_back(tree.panel_start.back() + int64_t{tree.columns(s)} * tree.height(s));
  tree.seconds = clock.seconds();
  return tree;
}

}  // namespace clatter::sparse
