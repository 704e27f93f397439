// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/tree_sweeps.hpp"

#include <algorithm>

#include "core/base/blas_kernel.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"

namespace clatter::sparse {

/// One solve.
struct TreeSweeps::Task {
  FactorView L;
  const std::vector<double>& scale;
  double* x;
  int64_t count;
  double* sums;  // of each thread for the rows of the top, thread after thread

  void scale_row(int64_t row) const {
    const double s = scale[L.tree->order[row]];
    for (int64_t c = 0; c < count; ++c) x[row * count + c] *= s;
  }
  FactorView subtree(int32_t lowest, int32_t root) const {
    FactorView view = L;
    view.from = lowest;
    view.to = root + 1;
    view.reach = L.reach_index();
    return view;
  }
  SweepColumns columns(const FactorView& view) const {
    return {x + view.first_index() * count, static_cast<int>(count), count};
  }
};

namespace {

/// Roots of subtrees of each thread, and the entries of L on the critical path.
struct Shares {
  TreeSchedule plan;
  std::vector<std::vector<int32_t>> roots;
  double cost = 0.0;
};

/// @param largest subtree, as a fraction of a thread's work.
Shares share_out(const SupernodeTree& tree, int threads, double largest) {
  std::vector<double> entries(static_cast<size_t>(tree.supernodes()));
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    entries[s] = static_cast<double>(tree.columns(s)) * tree.height(s);
  Shares out;
  out.plan = schedule(tree, threads, entries, largest);
  out.roots.resize(threads);
  std::vector<double> load(out.roots.size(), 0.0);
  for (const int32_t root : out.plan.subtrees) {
    const auto t = std::min_element(load.begin(), load.end()) - load.begin();
    out.roots[t].push_back(root);
    for (int32_t s = out.plan.lowest[root]; s <= root; ++s) load[t] += entries[s];
  }
  double top = 0.0;
  for (const int32_t s : out.plan.top) top += entries[s];
  // With few columns one thread does the top, with many all share it.
  out.cost = *std::max_element(load.begin(), load.end()) + top * 0.5 * (1.0 + 1.0 / threads);
  return out;
}

}  // namespace

TreeSweeps::TreeSweeps(const SupernodeTree& tree, int threads) {
  // Large subtrees leave little work in the top, small ones balance the threads.
  Shares best = share_out(tree, std::max(1, threads), 0.15);
  for (const double largest : {0.3, 0.6, 1.0}) {
    Shares other = share_out(tree, std::max(1, threads), largest);
    if (other.cost < best.cost) best = std::move(other);
  }
  shares_ = std::move(best.roots);
  TreeSchedule& plan = best.plan;
  lowest_ = std::move(plan.lowest);
  top_ = std::move(plan.top);
  for (const int32_t s : top_)
    for (int32_t j = 0; j < tree.columns(s); ++j) top_indices_.push_back(tree.first[s] + j);
  for (int32_t b = 0; b < tree.boundary; ++b) top_indices_.push_back(tree.size + b);
  index_.assign(tree.size + tree.boundary, -1);
  for (size_t k = 0; k < top_indices_.size(); ++k)
    index_[top_indices_[k]] = static_cast<int32_t>(k);
}

void TreeSweeps::forward_subtrees(const Task& task) const {
  const auto sums_of_thread = static_cast<int64_t>(top_indices_.size()) * task.count;
  parallel_pieces(static_cast<int64_t>(shares_.size()), [&](int64_t begin, int64_t end) {
    std::vector<double> work;
    for (int64_t t = begin; t < end; ++t) {
      double* sums = task.sums + t * sums_of_thread;
      std::fill_n(sums, sums_of_thread, 0.0);
      for (const int32_t root : shares_[t]) {
        const FactorView view = task.subtree(lowest_[root], root);
        for (int64_t j = view.first_index(); j < view.end_index(); ++j) task.scale_row(j);
        for (int32_t s = view.from; s <= root; ++s)
          forward_step(view, s, task.columns(view), work, {sums, index_.data()});
      }
    }
  });
}

void TreeSweeps::join_top(const Task& task) const {
  const auto rows = static_cast<int64_t>(top_indices_.size());
  const int32_t size = task.L.tree->size, reach = task.L.reach_index();
  parallel_pieces(rows, [&](int64_t begin, int64_t end) {
    for (int64_t k = begin; k < end; ++k) {
      const int32_t row = top_indices_[k];
      if (row >= reach) continue;
      if (row < size) task.scale_row(row);
      for (size_t t = 0; t < shares_.size(); ++t) {
        const double* sum = task.sums + (static_cast<int64_t>(t) * rows + k) * task.count;
        for (int64_t c = 0; c < task.count; ++c) task.x[row * task.count + c] += sum[c];
      }
    }
  });
}

void TreeSweeps::sweep_top(const Task& task, bool back) const {
  const int64_t lanes = task.count == 1 ? 1 : kLanes;
  parallel_pieces(task.count / lanes, [&](int64_t begin, int64_t end) {
    const SweepColumns part{task.x + begin * lanes, static_cast<int>((end - begin) * lanes),
                            task.count};
    std::vector<double> work;
    for (const int32_t s : top_) forward_step(task.L, s, part, work);
    if (!back) return;
    for (auto s = top_.rbegin(); s != top_.rend(); ++s) backward_step(task.L, *s, part, work);
  });
}

void TreeSweeps::backward_subtrees(const Task& task) const {
  parallel_pieces(static_cast<int64_t>(shares_.size()), [&](int64_t begin, int64_t end) {
    std::vector<double> work;
    for (int64_t t = begin; t < end; ++t) {
      for (const int32_t root : shares_[t]) {
        const FactorView view = task.subtree(lowest_[root], root);
        for (int32_t s = root; s >= view.from; --s)
          backward_step(view, s, task.columns(view), work);
      }
    }
  });
  parallel_pieces(task.L.tree->size, [&](int64_t begin, int64_t end) {
    for (int64_t j = begin; j < end; ++j) task.scale_row(j);
  });
}

std::unique_ptr<double[]> TreeSweeps::allocate_sums(int count) const {
  return large_array(shares_.size() * top_indices_.size() * static_cast<size_t>(count));
}

void TreeSweeps::solve(const FactorView& L, const std::vector<double>& scale, double* x,
                       int count) const {
  const BlasThreads one(1);
  const auto sums = allocate_sums(count);
  const Task task{L, scale, x, count, sums.get()};
  forward_subtrees(task);
  join_top(task);
  sweep_top(task, true);
  backward_subtrees(task);
}

void TreeSweeps::forward_to_boundary(const FactorView& L, const std::vector<double>& scale,
                                     double* x, int count) const {
  const BlasThreads one(1);
  const auto sums = allocate_sums(count);
  FactorView with_boundary = L;
  with_boundary.reach = L.tree->size + L.tree->boundary;
  const Task task{with_boundary, scale, x, count, sums.get()};
  forward_subtrees(task);
  join_top(task);
  sweep_top(task, false);
}

}  // namespace clatter::sparse
