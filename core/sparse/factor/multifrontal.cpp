// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/multifrontal.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>

#include "core/base/blas_kernel.hpp"
#include "core/base/progress.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/factor/buffer_pool.hpp"
#include "core/sparse/factor/tree_schedule.hpp"

namespace clatter::sparse {
namespace {

/// Workspace of one thread.
struct Workspace {
  std::vector<int32_t> local;      // row of the front by row of L
  std::vector<int32_t> child_row;  // row of the front by row of a child's update
  Buffer panel;
  BufferPool pool;

  explicit Workspace(const SupernodeTree& tree)
      : local(static_cast<size_t>(tree.size + tree.boundary)) {}
  double* scratch(size_t entries) {
    if (entries > panel.room) {
      pool.give(std::move(panel));
      panel = pool.take(entries);
    }
    return panel.data.get();
  }
};

class Elimination {
 public:
  Elimination(const SupernodeTree& tree, const PermutedMatrix& matrix, const FrontKernel& kernel,
              double* panels)
      : tree_(tree),
        matrix_(matrix),
        kernel_(kernel),
        panels_(panels),
        children_(tree.children()),
        updates_(tree.parent.size()),
        progress_("factor", tree.flops() * 1e-9, "GF") {}

  void run();
  void add_to(Eigen::MatrixXd& schur) const;

 private:
  void process(int32_t s, Workspace& work, bool wide);
  void assemble_matrix(int32_t s, const Workspace& work, const Front& front) const;
  void assemble_child(int32_t child, Workspace& work, const Front& front, bool wide) const;
  void report(double flops);

  const SupernodeTree& tree_;
  const PermutedMatrix& matrix_;
  const FrontKernel& kernel_;
  double* panels_;
  std::vector<std::vector<int32_t>> children_;
  std::vector<Buffer> updates_;
  std::mutex mutex_;
  Progress progress_;
  double done_ = 0.0;
};

void Elimination::assemble_matrix(int32_t s, const Workspace& work, const Front& front) const {
  const auto height = static_cast<size_t>(front.height());
  for (int j = 0; j < front.columns; ++j) {
    const auto index = static_cast<size_t>(tree_.first[s] + j);
    double* column = front.panel + static_cast<size_t>(j) * height;
    for (int64_t k = matrix_.starts[index]; k < matrix_.starts[index + 1]; ++k) {
      const auto row = static_cast<size_t>(matrix_.rows[k]);
      column[work.local[row]] += matrix_.values[k];
    }
  }
}

/// Adds the update matrix of a child to the front ("extend-add").
void Elimination::assemble_child(int32_t child, Workspace& work, const Front& front,
                                 bool wide) const {
  const int32_t q = tree_.below(child);
  const int32_t* rows = tree_.rows_of(child) + tree_.columns(child);
  work.child_row.resize(q);
  for (int32_t k = 0; k < q; ++k) work.child_row[k] = work.local[rows[k]];
  const double* update = updates_[child].data.get();
  const int32_t* row = work.child_row.data();
  const auto columns = [&](int64_t begin, int64_t end) {
    for (int64_t j = begin; j < end; ++j) {
      const double* from = update + j * q;
      const int64_t at = row[j];
      double* to = at < front.columns
                       ? front.panel + at * front.height()
                       : front.update + (at - front.columns) * front.below - front.columns;
      for (int64_t i = j; i < q; ++i) to[row[i]] += from[i];
    }
  };
  constexpr int32_t kWide = 1000;  // below this, starting threads costs more than it saves
  if (!wide || q < kWide) return columns(0, q);
  const int pieces = thread_count();
  const auto cut = [&](int64_t piece) {  // equal areas of the triangle
    return static_cast<int64_t>(q * (1.0 - std::sqrt(1.0 - static_cast<double>(piece) / pieces)));
  };
  parallel_pieces(pieces, [&](int64_t begin, int64_t end) { columns(cut(begin), cut(end)); });
}

/// Zeros panel and update, possibly the first access to their pages: large fronts on all threads.
void clear(const Front& front, bool wide) {
  constexpr int64_t kWide = 1 << 20;
  const int64_t height = front.height(), columns = front.columns;
  const auto column = [&](int64_t j) {
    if (j < columns) {
      std::fill_n(front.panel + j * height, height, 0.0);
      return;
    }
    const int64_t k = j - columns;
    std::fill(front.update + k * front.below + k, front.update + (k + 1) * front.below, 0.0);
  };
  const auto some = [&](int64_t begin, int64_t end) {
    for (int64_t j = begin; j < end; ++j) column(j);
  };
  if (!wide || height * height < kWide) return some(0, height);
  parallel_pieces(height, some);
}

void Elimination::process(int32_t s, Workspace& work, bool wide) {
  Front front;
  front.columns = tree_.columns(s);
  front.below = tree_.below(s);
  const auto height = static_cast<size_t>(front.height());
  const size_t panel_entries = height * static_cast<size_t>(front.columns);
  front.panel = panels_ != nullptr ? panels_ + tree_.panel_start[s] : work.scratch(panel_entries);
  const size_t update_entries = static_cast<size_t>(front.below) * static_cast<size_t>(front.below);
  Buffer update = work.pool.take(update_entries);
  front.update = update.data.get();
  clear(front, wide);
  const int32_t* rows = tree_.rows_of(s);
  for (int32_t k = 0; k < front.height(); ++k) work.local[rows[k]] = k;
  assemble_matrix(s, work, front);
  for (const int32_t child : children_[s]) {
    assemble_child(child, work, front, wide);
    work.pool.give(std::move(updates_[child]));
  }
  kernel_(s, front);
  updates_[s] = std::move(update);
}

void Elimination::report(double flops) {
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ += 1e-9 * flops;
  progress_.update(done_);
}

void Elimination::run() {
  const int threads = thread_count();
  const TreeSchedule plan = schedule(tree_, threads);
  if (!plan.subtrees.empty()) {
    const BlasThreads one(1);
    std::atomic<size_t> next{0};
    parallel_pieces(threads, [&](int64_t, int64_t) {
      Workspace work(tree_);
      for (size_t k = next++; k < plan.subtrees.size(); k = next++) {
        const int32_t root = plan.subtrees[k];
        double flops = 0.0;
        for (int32_t s = plan.lowest[root]; s <= root; ++s) {
          process(s, work, false);
          flops += tree_.flops(s);
        }
        report(flops);
      }
    });
  }
  Workspace work(tree_);
  for (const int32_t s : plan.top) {
    process(s, work, threads > 1);
    report(tree_.flops(s));
  }
}

void Elimination::add_to(Eigen::MatrixXd& schur) const {
  for (int32_t s = 0; s < tree_.supernodes(); ++s) {
    if (tree_.parent[s] >= 0) continue;
    const int32_t q = tree_.below(s);
    const int32_t* rows = tree_.rows_of(s) + tree_.columns(s);
    const double* update = updates_[s].data.get();
    for (int64_t j = 0; j < q; ++j) {
      for (int64_t i = j; i < q; ++i) {
        const int32_t a = rows[i] - tree_.size, b = rows[j] - tree_.size;
        schur(a, b) += update[i + j * q];
        if (a != b) schur(b, a) += update[i + j * q];
      }
    }
  }
}

}  // namespace

PermutedMatrix permuted(const SupernodeTree& tree, const SparseMatrix& lower,
                        const std::vector<double>& scale, const SparseMatrix& coupling) {
  const auto n = static_cast<size_t>(tree.size);
  const std::vector<int32_t> inverse = tree.inverse_order();
  const auto at = [&](Eigen::Index i) { return inverse[i]; };
  PermutedMatrix out;
  out.starts.assign(n + 1, 0);
  for (int j = 0; j < lower.cols(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it)
      if (it.row() >= j) ++out.starts[static_cast<size_t>(std::min(at(it.row()), at(j))) + 1];
  for (int b = 0; b < coupling.cols(); ++b)
    for (SparseMatrix::InnerIterator it(coupling, b); it; ++it)
      ++out.starts[static_cast<size_t>(at(it.row())) + 1];
  std::partial_sum(out.starts.begin(), out.starts.end(), out.starts.begin());
  out.rows.resize(out.starts[n]);
  out.values.resize(out.rows.size());
  std::vector<int64_t> next(out.starts.begin(), out.starts.end() - 1);
  const auto put = [&](int32_t column, int32_t row, double value) {
    const auto k = static_cast<size_t>(next[column]++);
    out.rows[k] = row;
    out.values[k] = value;
  };
  for (int j = 0; j < lower.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      if (it.row() < j) continue;
      const auto [column, row] = std::minmax({at(it.row()), at(j)});
      put(column, row, it.value() * scale[j] * scale[it.row()]);
    }
  }
  for (int b = 0; b < coupling.cols(); ++b)
    for (SparseMatrix::InnerIterator it(coupling, b); it; ++it)
      put(at(it.row()), tree.size + b, it.value() * scale[it.row()]);
  return out;
}

void eliminate(const SupernodeTree& tree, const PermutedMatrix& matrix, const FrontKernel& kernel,
               double* panels, Eigen::MatrixXd* schur) {
  Elimination elimination(tree, matrix, kernel, panels);
  elimination.run();
  if (schur == nullptr) return;
  *schur = Eigen::MatrixXd::Zero(tree.boundary, tree.boundary);
  elimination.add_to(*schur);
}

}  // namespace clatter::sparse
