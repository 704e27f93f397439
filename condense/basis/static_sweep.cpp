// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/static_sweep.hpp"

#include <cblas.h>
#include <fmt/format.h>

#include <algorithm>
#include <barrier>

#include "condense/basis/schur_mass.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/progress.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/dense_product.hpp"
#include "core/sparse/factor/buffer_pool.hpp"
#include "core/sparse/factor/multifrontal.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kPanel = 2048;  // rows of Psi per product

/// Data shared by the threads of one sweep. Rows are those of z = S^{-1} Psi, S the factor's scale.
class Sweep {
 public:
  Sweep(const sparse::SupernodalFactor& factor, const PartitionedMatrix& M,
        const std::vector<int32_t>& kept, bool with_mass);
  void run();

  MatrixXd half_mass;  // M_bb is this + its transpose + the boundary's own mass
  RowMatrix rows;      // Psi at the kept DoFs

 private:
  friend class Worker;
  const sparse::SupernodalFactor& factor_;
  const sparse::SupernodeTree& tree_;
  sparse::PermutedMatrix mass_;
  std::vector<int32_t> kept_at_;  // row of `rows` by permuted index, or -1
  std::vector<int32_t> children_;
  std::vector<char> used_;  // supernodes that the sweep visits
  bool with_mass_;          // sums M_bb, of all rows
  Index n_b_, panel_rows_ = kPanel;
  RowMatrix panel_, image_;  // rows of z, and of the half of M z that belongs to them
};

Sweep::Sweep(const sparse::SupernodalFactor& factor, const PartitionedMatrix& M,
             const std::vector<int32_t>& kept, bool with_mass)
    : factor_(factor),
      tree_(factor.tree()),
      mass_(with_mass ? sparse::permuted(tree_, M.ii, factor.scale(), M.ib)
                      : sparse::PermutedMatrix()),
      kept_at_(static_cast<size_t>(tree_.size), -1),
      children_(tree_.parent.size(), 0),
      used_(tree_.parent.size(), with_mass ? 1 : 0),
      with_mass_(with_mass),
      n_b_(tree_.boundary) {
  std::vector<int32_t> by_unknown(static_cast<size_t>(tree_.size), -1);
  for (size_t k = 0; k < kept.size(); ++k) by_unknown[kept[k]] = static_cast<int32_t>(k);
  for (size_t j = 0; j < kept_at_.size(); ++j) kept_at_[j] = by_unknown[tree_.order[j]];
  for (int32_t s = 0; s < tree_.supernodes(); ++s) {
    panel_rows_ = std::max<Index>(panel_rows_, tree_.columns(s));
    char& used = used_[s];
    const auto begin = kept_at_.begin() + tree_.first[s];
    if (std::any_of(begin, begin + tree_.columns(s), [](int32_t row) { return row >= 0; }))
      used = 1;
    const int32_t parent = tree_.parent[s];
    if (used == 0 || parent < 0) continue;
    used_[parent] = 1;
    ++children_[parent];
  }
  rows.resize(static_cast<Index>(kept.size()), n_b_);
  panel_.resize(panel_rows_, n_b_);
  if (!with_mass) return;
  half_mass = MatrixXd::Zero(n_b_, n_b_);
  image_.resize(panel_rows_, n_b_);
}

/// One thread's columns [begin, end) of Psi. All workers take the same steps and synchronise at
/// each full panel.
class Worker {
 public:
  Worker(Sweep& shared, std::barrier<>& meeting, Index begin, Index end)
      : shared_(shared),
        tree_(shared.tree_),
        meeting_(meeting),
        begin_(begin),
        width_(end - begin),
        fronts_(tree_.parent.size()),
        left_(shared.children_),
        local_(static_cast<size_t>(tree_.size + tree_.boundary)) {}

  void run(Progress* progress) {
    for (int32_t s = tree_.supernodes() - 1; s >= 0; --s) {
      if (shared_.used_[s] == 0) continue;
      if (filled_ + tree_.columns(s) > shared_.panel_rows_) use_panel();
      visit(s);
      filled_ += tree_.columns(s);
      if (progress != nullptr) progress->update(static_cast<double>(tree_.size - first(s)));
    }
    use_panel();
  }

 private:
  int32_t first(int32_t s) const { return tree_.first[s]; }
  void visit(int32_t s);
  void take_rows_above(int32_t s, double* front);
  void solve_own_rows(int32_t s, double* front) const;
  void write_panel(int32_t s, const double* front);
  void release_parent(int32_t s);
  void use_panel();
  void keep_rows() const;

  Sweep& shared_;
  const sparse::SupernodeTree& tree_;
  std::barrier<>& meeting_;
  Index begin_, width_;
  std::vector<sparse::Buffer> fronts_;  // height x width, row by row, while children need them
  std::vector<int32_t> left_;           // children that still need the front
  std::vector<int32_t> local_;          // row of the current front by permuted index
  std::vector<int32_t> indices_;        // permuted indices of the panel's rows
  sparse::BufferPool pool_;
  Index filled_ = 0;
};

void Worker::visit(int32_t s) {
  const auto entries = static_cast<size_t>(tree_.height(s) * width_);
  sparse::Buffer front = pool_.take(entries);
  take_rows_above(s, front.data.get());
  solve_own_rows(s, front.data.get());
  write_panel(s, front.data.get());
  release_parent(s);
  if (left_[s] > 0) {
    fronts_[s] = std::move(front);
  } else {
    pool_.give(std::move(front));
  }
}

/// Rows below the own ones: from the parent's front, or unit rows on the boundary.
void Worker::take_rows_above(int32_t s, double* front) {
  const int32_t parent = tree_.parent[s];
  const int32_t* rows = tree_.rows_of(s);
  const int32_t* above = parent >= 0 ? tree_.rows_of(parent) : nullptr;
  const double* source = parent >= 0 ? fronts_[parent].data.get() : nullptr;
  Index at = 0;
  for (Index k = tree_.columns(s); k < tree_.height(s); ++k) {
    double* row = front + k * width_;
    if (rows[k] >= tree_.size) {
      std::fill_n(row, width_, 0.0);
      const Index column = rows[k] - tree_.size - begin_;
      if (column >= 0 && column < width_) row[column] = 1.0;
      continue;
    }
    while (above[at] != rows[k]) ++at;
    std::copy_n(source + at * width_, width_, row);
  }
}

/// L11^T z_S = -L21^T z_R.
void Worker::solve_own_rows(int32_t s, double* front) const {
  const int p = tree_.columns(s), q = tree_.below(s), h = tree_.height(s),
            w = sparse::blas_size(width_);
  const double* L = shared_.factor_.view().panels + tree_.panel_start[s];
  if (q == 0) {
    std::fill_n(front, p * width_, 0.0);
    return;
  }
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, w, p, q, -1.0, front + p * width_, w,
              L + p, h, 0.0, front, w);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, w, p, 1.0, L, h,
              front, w);
}

/// The own rows and, from the columns of M, their half of M z.
void Worker::write_panel(int32_t s, const double* front) {
  const int32_t* rows = tree_.rows_of(s);
  for (int32_t k = 0; k < tree_.height(s); ++k) local_[rows[k]] = k;
  for (int32_t j = 0; j < tree_.columns(s); ++j) {
    const int32_t index = first(s) + j;
    const double* z = front + j * width_;
    std::copy_n(z, width_, &shared_.panel_(filled_ + j, begin_));
    indices_.push_back(index);
    if (!shared_.with_mass_) continue;
    double* image = &shared_.image_(filled_ + j, begin_);
    std::fill_n(image, width_, 0.0);
    const auto& mass = shared_.mass_;
    for (int64_t k = mass.starts[index]; k < mass.starts[static_cast<size_t>(index) + 1]; ++k) {
      const int32_t row = mass.rows[k];
      const double m = mass.values[k] * (row == index ? 0.5 : 1.0);
      const double* other = front + local_[row] * width_;
      for (Index c = 0; c < width_; ++c) image[c] += m * other[c];
    }
  }
}

void Worker::release_parent(int32_t s) {
  const int32_t parent = tree_.parent[s];
  if (parent < 0 || --left_[parent] > 0) return;
  pool_.give(std::move(fronts_[parent]));
}

void Worker::use_panel() {
  meeting_.arrive_and_wait();
  const int n_b = sparse::blas_size(shared_.n_b_);
  if (filled_ > 0 && shared_.with_mass_)
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n_b, sparse::blas_size(width_),
                sparse::blas_size(filled_), 1.0, shared_.panel_.data(), n_b,
                &shared_.image_(0, begin_), n_b, 1.0, &shared_.half_mass(0, begin_), n_b);
  if (filled_ > 0) keep_rows();
  meeting_.arrive_and_wait();
  filled_ = 0;
  indices_.clear();
}

/// Kept rows, by columns.
void Worker::keep_rows() const {
  const auto& scale = shared_.factor_.scale();
  for (Index k = 0; k < filled_; ++k) {
    const auto index = static_cast<size_t>(indices_[k]);
    if (shared_.kept_at_[index] < 0) continue;
    shared_.rows.row(shared_.kept_at_[index]).segment(begin_, width_) =
        scale[tree_.order[index]] * shared_.panel_.row(k).segment(begin_, width_);
  }
}

void Sweep::run() {
  const BlasThreads one(1);
  Progress progress("constraint modes", static_cast<double>(tree_.size), "rows");
  const auto workers = static_cast<std::ptrdiff_t>(std::min<Index>(thread_count(), n_b_));
  std::barrier<> meeting(workers);
  parallel_pieces(n_b_, [&](int64_t begin, int64_t end) {
    try {
      Worker(*this, meeting, begin, end).run(begin == 0 ? &progress : nullptr);
    } catch (...) {
      meeting.arrive_and_drop();  // the others finish, then the exception is rethrown
      throw;
    }
  });
}

/// Upper bound of the entries of the fronts on one path, all columns together.
double path_entries(const sparse::SupernodeTree& tree) {
  std::vector<double> above(tree.parent.size(), 0.0);
  double most = 0.0;
  for (int32_t s = tree.supernodes() - 1; s >= 0; --s) {
    const int32_t parent = tree.parent[s];
    double& path = above[s];
    path = static_cast<double>(tree.height(s)) + (parent >= 0 ? above[parent] : 0.0);
    most = std::max(most, path);
  }
  return most * static_cast<double>(tree.boundary);
}

void require_memory_for(const sparse::SupernodeTree& tree, size_t kept, bool with_mass) {
  const double n_b = tree.boundary, panels = with_mass ? 2.0 : 1.0;
  const double sweep =
      with_mass || kept > 0 ? path_entries(tree) + panels * static_cast<double>(kPanel) * n_b : 0.0;
  const double work =
      with_mass ? sweep : std::max(sweep, static_cast<double>(tree.stack_entries()));
  const double entries = work + (3.0 * n_b + static_cast<double>(kept)) * n_b;
  require_memory(fmt::format("the static reduction to {} boundary coordinates with {} kept rows",
                             tree.boundary, kept),
                 gib_of_doubles(entries), "retain fewer coordinates, or keep fewer rows (skin)");
}

bool sweep_is_cheaper(const sparse::SupernodeTree& tree) {
  const double n_b = tree.boundary;
  return 2.0 * tree.size * n_b * n_b <= schur_mass_flops(tree);
}

}  // namespace

StaticShapes sweep_shapes(const sparse::SupernodalFactor& factor_ii, const PartitionedMatrix& M,
                          const std::vector<int32_t>& kept, StaticMass method) {
  const bool with_mass = method == StaticMass::kSweep ||
                         (method == StaticMass::kCheaper && sweep_is_cheaper(factor_ii.tree()));
  require_memory_for(factor_ii.tree(), kept.size(), with_mass);
  StaticShapes out;
  Sweep sweep(factor_ii, M, kept, with_mass);
  if (with_mass || !kept.empty()) sweep.run();
  out.rows.swap(sweep.rows);
  out.M_bb = M.bb + (with_mass ? MatrixXd(sweep.half_mass + sweep.half_mass.transpose())
                               : schur_mass(factor_ii, M.ii, M.ib));
  return out;
}

}  // namespace clatter::condense
