#include "modal/factor/tree_sweeps.hpp"

#include <algorithm>

#include "core/blas_kernel.hpp"
#include "core/large_pages.hpp"
#include "core/threads.hpp"
#include "modal/factor/sweep_kernel.hpp"

namespace clatter::modal {

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

TreeSweeps::TreeSweeps(const SupernodeTree& tree, int threads)
    : shares_(static_cast<size_t>(std::max(1, threads))) {
  constexpr double kShare = 0.15;
  std::vector<double> entries(static_cast<size_t>(tree.supernodes()));
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    entries[static_cast<size_t>(s)] = static_cast<double>(tree.columns(s)) * tree.height(s);
  TreeSchedule plan = schedule(tree, threads, std::move(entries), kShare);
  std::vector<int64_t> load(shares_.size(), 0);
  for (const int32_t root : plan.subtrees) {
    const auto t = static_cast<size_t>(std::min_element(load.begin(), load.end()) - load.begin());
    const int32_t lowest = plan.lowest[static_cast<size_t>(root)];
    shares_[t].push_back(root);
    load[t] += tree.panel_start[static_cast<size_t>(root) + 1] -
               tree.panel_start[static_cast<size_t>(lowest)];
  }
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

}  // namespace clatter::modal
