// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/amls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/blas_kernel.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/progress.hpp"
#include "core/base/threads.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/eigen/block_lanczos.hpp"
#include "core/sparse/eigen/local_modes.hpp"
#include "core/sparse/eigen/mode_density.hpp"
#include "core/sparse/eigen/refinement.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kNarrow = kLanes;       // vectors per subtree product on one thread
constexpr int kWide = 2 * kLanes;     // the same on all threads
constexpr Index kAnswerColumns = 32;  // result vectors computed at a time

/// The projection of A on modes of substructures.
class Multilevel {
 public:
  Multilevel(const SubtreeProduct& A, const SupernodeTree& tree, const AmlsOptions& options);
  /// Computes the modes of all substructures with nu >= cut.
  void find_local_modes(double cut);
  Index modes() const { return start_.back(); }
  /// Number of products with a subtree of the factor.
  int64_t solves() const { return solves_; }
  /// V^T A V, both triangles.
  MatrixXd projected() const;
  /// Columns of S L^{-T} V q scaled by nu^{-1/2}: M-orthonormal displacements in elimination order.
  MatrixXd motions(const MatrixXd& q, const VectorXd& nu) const;

 private:
  const Substructure& part(Index k) const { return parts_[k]; }
  int32_t own_rows(Index k) const {
    return A_.first_index(part(k).to) - A_.first_index(part(k).from);
  }
  int32_t subtree_rows(Index k) const {
    return A_.first_index(part(k).to) - A_.first_index(part(k).lowest);
  }
  void solve_part(Index k, double cut, bool wide);
  /// Substructures [begin, end) are complete subtrees for one thread; the others follow.
  std::vector<std::pair<Index, Index>> narrow_subtrees() const;

  const SubtreeProduct& A_;
  const AmlsOptions& options_;
  const Index size_;
  std::vector<Substructure> parts_;
  std::vector<LocalModes> local_;
  std::atomic<int64_t> solves_{0};
  std::vector<Index> start_;  // first mode of each substructure
};

Multilevel::Multilevel(const SubtreeProduct& A, const SupernodeTree& tree,
                       const AmlsOptions& options)
    : A_(A),
      options_(options),
      size_(tree.size),
      parts_(partition(tree, {options.leaf, options.leaf / 4})),
      local_(parts_.size()) {}

void Multilevel::solve_part(Index k, double cut, bool wide) {
  const int b = wide ? kWide : kNarrow;
  const Index rows = subtree_rows(k), own = own_rows(k);
  const std::unique_ptr<double[]> x = large_array(static_cast<size_t>(rows * b));
  const std::unique_ptr<double[]> z = large_array(static_cast<size_t>(rows * b));
  const int32_t origin = A_.first_index(part(k).lowest);
  LocalOperator local{own, 0, {}};
  for (Index d = part(k).first_inside; d < k; ++d) local.inside += local_[d].values.size();
  local.apply = [&](const MatrixXd& Q, MatrixXd& W, MatrixXd& C) {
    std::fill_n(x.get(), (rows - own) * b, 0.0);
    Eigen::Map<RowMatrix>(x.get() + (rows - own) * b, own, b) = Q;
    A_.apply(part(k), x.get(), z.get(), b, wide);
    solves_ += b;
    W = Eigen::Map<const RowMatrix>(z.get() + (rows - own) * b, own, b);
    C.resize(local.inside, b);
    Index at = 0;
    for (Index d = part(k).first_inside; d < k; ++d) {
      const MatrixXd& V = local_[d].vectors;
      const double* image = z.get() + Index{A_.first_index(part(d).from) - origin} * b;
      C.middleRows(at, V.cols()).noalias() =
          V.transpose() * Eigen::Map<const RowMatrix>(image, V.rows(), b);
      at += V.cols();
    }
  };
  const uint64_t seed = options_.seed + 104729 * static_cast<uint64_t>(k);
  local_[k] = local_modes(local, {cut, b, seed});
}

std::vector<std::pair<Index, Index>> Multilevel::narrow_subtrees() const {
  const Index most = std::max<Index>(size_ / (16 * thread_count()), 1);
  std::vector<std::pair<Index, Index>> out;
  for (Index k = static_cast<Index>(parts_.size()); k-- > 0;) {
    if (thread_count() == 1 || subtree_rows(k) > most) continue;
    out.emplace_back(part(k).first_inside, k + 1);
    k = part(k).first_inside;
  }
  std::sort(out.begin(), out.end(),
            [](auto a, auto b) { return a.second - a.first > b.second - b.first; });
  return out;
}

void Multilevel::find_local_modes(double cut) {
  const BlasThreads one(1);
  const auto subtrees = narrow_subtrees();
  std::vector<char> done(parts_.size(), 0);
  std::atomic<size_t> next{0};
  parallel_pieces(thread_count(), [&](int64_t, int64_t) {
    for (size_t at = next++; at < subtrees.size(); at = next++)
      for (Index k = subtrees[at].first; k < subtrees[at].second; ++k) {
        solve_part(k, cut, false);
        done[k] = 1;
      }
  });
  Progress progress("substructures", static_cast<double>(parts_.size()));
  start_.assign(1, 0);
  for (size_t k = 0; k < parts_.size(); ++k) {
    if (done[k] == 0) solve_part(static_cast<Index>(k), cut, true);
    start_.push_back(start_.back() + local_[k].values.size());
    progress.update(static_cast<double>(k + 1));
  }
}

MatrixXd Multilevel::projected() const {
  MatrixXd T = MatrixXd::Zero(modes(), modes());
  for (size_t k = 0; k < parts_.size(); ++k) {
    const LocalModes& local = local_[k];
    const Index first = start_[parts_[k].first_inside], at = start_[k];
    const Index count = local.values.size();
    T.block(first, at, at - first, count) = local.coupling;
    T.block(at, first, count, at - first) = local.coupling.transpose();
    T.block(at, at, count, count) = local.values.asDiagonal();
  }
  return T;
}

MatrixXd Multilevel::motions(const MatrixXd& q, const VectorXd& nu) const {
  const BlasThreads one(1);
  MatrixXd out(size_, q.cols());
  prefer_large_pages(out.data(), static_cast<size_t>(out.size()) * sizeof(double));
  RowMatrix x(size_, kAnswerColumns);
  for (Index first = 0; first < q.cols(); first += kAnswerColumns) {
    const Index count = std::min(kAnswerColumns, q.cols() - first);
    x.setZero();
    for (size_t k = 0; k < parts_.size(); ++k) {
      const MatrixXd& V = local_[k].vectors;
      x.block(A_.first_index(parts_[k].from), 0, V.rows(), count).noalias() =
          V * q.block(start_[k], first, V.cols(), count);
    }
    A_.to_displacement(x.data(), kAnswerColumns);
    out.middleCols(first, count) =
        x.leftCols(count) * nu.segment(first, count).cwiseSqrt().cwiseInverse().asDiagonal();
  }
  return out;
}

/// The `count` largest eigenpairs of a dense matrix, values 1 / nu ascending.
EigenResult largest_pairs(const MatrixXd& T, int count, uint64_t seed) {
  constexpr Index kDense = 1200;  // up to this size divide and conquer is as fast
  EigenResult out;
  if (T.rows() <= kDense || 4 * Index{count} > T.rows()) {
    const dense::Eigenpairs eig = dense::symmetric_eigen(T);
    if (!eig.ok) return out;
    out.values = eig.values.reverse().head(count).cwiseInverse();
    out.vectors = eig.vectors.rowwise().reverse().leftCols(count);
    out.status = EigenStatus::kConverged;
    return out;
  }
  const auto rows_of = [&](double* x, int b) { return Eigen::Map<RowMatrix>(x, T.rows(), b); };
  ShiftInvert problem;
  problem.size = T.rows();
  problem.solve = [&](const double* x, double* y, int b) {
    const MatrixXd from = rows_of(const_cast<double*>(x), b);
    parallel_pieces(T.rows(), [&](int64_t begin, int64_t end) {
      rows_of(y, b).middleRows(begin, end - begin).noalias() =
          T.middleCols(begin, end - begin).transpose() * from;
    });
  };
  problem.mass = [&](const double* x, double* y, int b) { std::copy_n(x, T.rows() * b, y); };
  BlockLanczosOptions lanczos;
  lanczos.count = count;
  lanczos.tolerance = 1e-6;
  lanczos.seed = seed;
  return solve_block_lanczos(problem, lanczos);
}

/// Relative decrease of the frequencies in a step. A rigid-body mode is scaled by a tenth of the
/// first elastic frequency, since its own is meaningless.
VectorXd lowered(const VectorXd& before, const VectorXd& after, double sigma) {
  constexpr double kElastic = 1e-5, kOfRigid = 1e-2;
  double floor = 0.0;
  for (Index j = after.size(); j-- > 0;)
    if (after[j] > kElastic * std::abs(sigma)) floor = kOfRigid * after[j];
  const VectorXd scale = after.cwiseMax(std::max(floor, 1e-300));
  return 0.5 * (before - after).cwiseQuotient(scale).cwiseMax(0.0);
}

/// Requires memory for the result vectors, for the blocks of a step, and first for the projection
/// on `modes` modes of substructures with its eigen-solver.
void require_room(Index size, int requested, Index modes) {
  const auto n = static_cast<double>(size), p = static_cast<double>(modes);
  const double vectors = n * static_cast<double>(requested + 2 * kAnswerColumns);
  const double projection = p * (p + std::min(4.0 * p, 4.0 * requested));
  require_memory(fmt::format("AMLS with {} vectors of {} unknowns", requested, size),
                 gib_of_doubles(std::max(vectors, projection)),
                 "request fewer modes or raise the limit (--memory-limit)");
}

/// The lowest `requested` pairs of the projection on modes of substructures with nu >= cut; empty
/// when there are too few of these.
EigenResult project(const ShiftInvert& problem, const SubtreeProduct& A, const SupernodeTree& tree,
                    const AmlsOptions& options, int requested, double cut) {
  Multilevel levels(A, tree, options);
  levels.find_local_modes(cut);
  EigenResult out;
  out.status = EigenStatus::kNotConverged;
  out.message = fmt::format("{} modes of substructures are too few", levels.modes());
  if (levels.modes() < requested) return out;
  require_room(problem.size, requested, levels.modes());
  out = largest_pairs(levels.projected(), requested, options.seed);
  if (!out.ok()) return out;
  out.vectors = levels.motions(out.vectors, out.values.cwiseInverse());
  out.values.array() += problem.sigma;
  out.solves = levels.solves();
  return out;
}

/// The lowest pairs are near the known motions and are dropped; the others are made M-orthogonal to
/// them.
void remove_known(const KnownMotions& known, EigenResult& out) {
  const Index count = known.count(), n = out.vectors.rows();
  if (count == 0) return;
  const Index left = out.values.size() - count;
  out.values = VectorXd(out.values.tail(left));
  RowMatrix block;
  for (Index first = 0; first < left; first += kAnswerColumns) {
    const Index columns = std::min(kAnswerColumns, left - first);
    block = out.vectors.middleCols(count + first, columns);
    known.remove(block.data(), static_cast<int>(columns));
    out.vectors.middleCols(first, columns) = block;
  }
  out.vectors.conservativeResize(n, left);
}

/// Refines the pairs of a projection until a step lowers no wanted frequency by more than
/// `accuracy`.
void refine(const ShiftInvert& problem, const SymmetricOperator& mass, const AmlsOptions& options,
            EigenResult& out) {
  for (int step = 0; step < options.max_refinements; ++step) {
    const VectorXd before = out.values;
    refine_modes(problem, mass, out.vectors, out.values);
    out.solves += before.size();
    out.errors = lowered(before, out.values, problem.sigma).head(options.count);
    if (out.errors.maxCoeff() <= options.accuracy) return;
  }
  out.status = EigenStatus::kNotConverged;
  out.message = fmt::format("{} steps still lowered a frequency by {:.1e}, expected {:.1e}",
                            options.max_refinements, out.errors.maxCoeff(), options.accuracy);
}

}  // namespace

EigenResult solve_amls(ShiftedPencil& pencil, const AmlsOptions& options) {
  constexpr int kTries = 4;
  constexpr double kWider = 2.25;  // factor on eigenvalues between attempts
  const ShiftInvert& problem = pencil.problem();
  const auto size = static_cast<Index>(problem.size);
  const auto known = static_cast<int>(pencil.rigid().count());
  const int spare =
      std::max(8, options.count / 20);  // the highest Ritz vectors are the least accurate
  const int requested = static_cast<int>(std::min<Index>(options.count + spare + known, size));
  require_room(size, requested, 0);
  const SupernodalFactor& factor = pencil.local_factor();
  const SubtreeProduct A(factor, pencil.local_mass());
  const double nu = ModeDensity(A, size, options.seed).nu_above(options.count + known);
  double highest = std::max(1.0 / nu + problem.sigma, 0.0) * options.cutoff * options.cutoff;
  EigenResult out;
  for (int attempt = 0; attempt < kTries && !out.ok(); ++attempt, highest *= kWider) {
    out.vectors.resize(0, 0);
    out = project(problem, A, factor.tree(), options, requested, 1.0 / (highest - problem.sigma));
    if (!out.ok()) continue;
    remove_known(pencil.rigid(), out);
    refine(problem, pencil.mass(), options, out);
  }
  if (!out.ok()) return out;
  out.solves += ModeDensity::kSolves;
  out.values.conservativeResize(options.count);
  out.vectors.conservativeResize(size, options.count);
  return out;
}

}  // namespace clatter::sparse
