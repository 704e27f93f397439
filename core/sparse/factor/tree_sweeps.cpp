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
  double* sums;  // of each thread for the rows of the top, one thread behind the other

  void scale_place(int64_t place) const {
    const double s = scale[static_cast<size_t>(L.tree->order[static_cast<size_t>(place)])];
    for (int64_t c = 0; c < count; ++c) x[place * count + c] *= s;
  }
  FactorView subtree(int32_t lowest, int32_t root) const {
    FactorView view = L;
    view.from = lowest;
    view.to = root + 1;
    view.reach = L.reach_place();
    return view;
  }
  SweepColumns columns(const FactorView& view) const {
    return {x + view.first_place() * count, static_cast<int>(count), count};
  }
};

namespace {

/// Roots of subtrees of each thread, and the entries of L that a solve waits for.
struct Shares {
  TreeSchedule plan;
  std::vector<std::vector<int32_t>> roots;
  double cost = 0.0;
};

/// @param largest subtree, in parts of a thread's work.
Shares share_out(const SupernodeTree& tree, int threads, double largest) {
  std::vector<double> entries(static_cast<size_t>(tree.supernodes()));
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    entries[static_cast<size_t>(s)] = static_cast<double>(tree.columns(s)) * tree.height(s);
  Shares out;
  out.plan = schedule(tree, threads, entries, largest);
  out.roots.resize(static_cast<size_t>(threads));
  std::vector<double> load(out.roots.size(), 0.0);
  for (const int32_t root : out.plan.subtrees) {
    const auto t = std::min_element(load.begin(), load.end()) - load.begin();
    out.roots[static_cast<size_t>(t)].push_back(root);
    for (int32_t s = out.plan.lowest[static_cast<size_t>(root)]; s <= root; ++s)
      load[static_cast<size_t>(t)] += entries[static_cast<size_t>(s)];
  }
  double top = 0.0;
  for (const int32_t s : out.plan.top) top += entries[static_cast<size_t>(s)];
  // Few columns leave the top to one thread, many share it.
  out.cost = *std::max_element(load.begin(), load.end()) + top * 0.5 * (1.0 + 1.0 / threads);
  return out;
}

}  // namespace

TreeSweeps::TreeSweeps(const SupernodeTree& tree, int threads) {
  // Large subtrees leave little to the top, small ones load the threads evenly.
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
    for (int32_t j = 0; j < tree.columns(s); ++j)
      top_places_.push_back(tree.first[static_cast<size_t>(s)] + j);
  for (int32_t b = 0; b < tree.boundary; ++b) top_places_.push_back(tree.size + b);
  index_.assign(static_cast<size_t>(tree.size + tree.boundary), -1);
  for (size_t k = 0; k < top_places_.size(); ++k)
    index_[static_cast<size_t>(top_places_[k])] = static_cast<int32_t>(k);
}

void TreeSweeps::forward_subtrees(const Task& task) const {
  const auto sums_of_thread = static_cast<int64_t>(top_places_.size()) * task.count;
  parallel_pieces(static_cast<int64_t>(shares_.size()), [&](int64_t begin, int64_t end) {
    std::vector<double> work;
    for (int64_t t = begin; t < end; ++t) {
      double* sums = task.sums + t * sums_of_thread;
      std::fill_n(sums, sums_of_thread, 0.0);
      for (const int32_t root : shares_[static_cast<size_t>(t)]) {
        const FactorView view = task.subtree(lowest_[static_cast<size_t>(root)], root);
        for (int64_t j = view.first_place(); j < view.end_place(); ++j) task.scale_place(j);
        for (int32_t s = view.from; s <= root; ++s)
          forward_step(view, s, task.columns(view), work, {sums, index_.data()});
      }
    }
  });
}

void TreeSweeps::join_top(const Task& task) const {
  const auto places = static_cast<int64_t>(top_places_.size());
  const int32_t size = task.L.tree->size, reach = task.L.reach_place();
  parallel_pieces(places, [&](int64_t begin, int64_t end) {
    for (int64_t k = begin; k < end; ++k) {
      const int32_t place = top_places_[static_cast<size_t>(k)];
      if (place >= reach) continue;
      if (place < size) task.scale_place(place);
      for (size_t t = 0; t < shares_.size(); ++t) {
        const double* sum = task.sums + (static_cast<int64_t>(t) * places + k) * task.count;
        for (int64_t c = 0; c < task.count; ++c) task.x[place * task.count + c] += sum[c];
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
      for (const int32_t root : shares_[static_cast<size_t>(t)]) {
        const FactorView view = task.subtree(lowest_[static_cast<size_t>(root)], root);
        for (int32_t s = root; s >= view.from; --s)
          backward_step(view, s, task.columns(view), work);
      }
    }
  });
  parallel_pieces(task.L.tree->size, [&](int64_t begin, int64_t end) {
    for (int64_t j = begin; j < end; ++j) task.scale_place(j);
  });
}

std::unique_ptr<double[]> TreeSweeps::room_for_sums(int count) const {
  return large_array(shares_.size() * top_places_.size() * static_cast<size_t>(count));
}

void TreeSweeps::solve(const FactorView& L, const std::vector<double>& scale, double* x,
                       int count) const {
  const BlasThreads one(1);
  const auto sums = room_for_sums(count);
  const Task task{L, scale, x, count, sums.get()};
  forward_subtrees(task);
  join_top(task);
  sweep_top(task, true);
  backward_subtrees(task);
}

void TreeSweeps::forward_to_boundary(const FactorView& L, const std::vector<double>& scale,
                                     double* x, int count) const {
  const BlasThreads one(1);
  const auto sums = room_for_sums(count);
  FactorView whole = L;
  whole.reach = L.tree->size + L.tree->boundary;
  const Task task{whole, scale, x, count, sums.get()};
  forward_subtrees(task);
  join_top(task);
  sweep_top(task, false);
}

}  // namespace clatter::sparse
