// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/supernodal_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <random>

#include "core/base/h5_file.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/stopwatch.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/factor/multifrontal.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"
#include "core/sparse/factor/tree_sweeps.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;

constexpr Index kBlock = 128;  // right-hand sides per sweep of all threads

FactorReport report_of(const SupernodeTree& tree, const SparseMatrix& lower) {
  constexpr double kCopies = 5.0;  // doubles per entry of A: scaled, permuted, shifted copies
  FactorReport report;
  report.size = tree.size;
  report.entries = tree.entries();
  report.flops = tree.flops();
  report.predicted_gib = gib_of_doubles(static_cast<double>(report.entries + tree.stack_entries()) +
                                        kCopies * static_cast<double>(lower.nonZeros()));
  report.ordering = tree.ordering;
  report.analyse_seconds = tree.seconds;
  return report;
}

void refuse_if_too_large(const FactorReport& report, const FactorOptions& options) {
  const double left = options.memory_limit_gib > 0.0 ? options.memory_limit_gib
                                                     : memory_left_gib(report.predicted_gib);
  if (report.predicted_gib <= left) return;
  throw MemoryShort(fmt::format(
      "the factor of {} unknowns needs {} ({} entries), {} are left: use a coarser mesh or raise "
      "the limit (--memory-limit)",
      report.size, memory_text(report.predicted_gib), report.entries, memory_text(left)));
}

Eigen::VectorXd random_vector(Index n) {
  std::mt19937_64 engine(20240607);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::VectorXd b(n);
  for (double& value : b) value = uniform(engine);
  return b;
}

/// 1 or the next multiple of kLanes.
Index whole_lanes(Index count) { return count == 1 ? 1 : (count + kLanes - 1) / kLanes * kLanes; }

}  // namespace

std::vector<double> power_of_two_scale(const SparseMatrix& lower) {
  std::vector<double> scale(static_cast<size_t>(lower.cols()), 1.0);
  for (int j = 0; j < lower.cols(); ++j) {
    const double d = lower.coeff(j, j);
    if (!(d > 0.0) || !std::isfinite(d)) {
      throw NotPositiveDefinite(
          fmt::format("matrix is not positive definite: diagonal {} is {}", j, d), j);
    }
    scale[j] = std::exp2(-std::round(0.5 * std::log2(d)));
  }
  return scale;
}

struct SupernodalFactor::Impl {
  std::vector<double> scale;
  SupernodeTree tree;
  TreeSweeps sweeps;
  std::unique_ptr<double[]> panels;
  Eigen::MatrixXd boundary_part;
  FactorReport report;

  FactorView view() const { return {&tree, panels.get()}; }
  void factorise(const SparseMatrix& lower, const SparseMatrix& coupling);
  void check_pivots(const FactorOptions& options);
  void probe(const SparseMatrix& lower, const FactorOptions& options);
  template <class Use>
  void by_blocks(const Eigen::Ref<const Eigen::MatrixXd>& b, Use&& use) const;
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  Eigen::MatrixXd boundary_product(const Eigen::Ref<const Eigen::MatrixXd>& f) const;
};

void SupernodalFactor::Impl::factorise(const SparseMatrix& lower, const SparseMatrix& coupling) {
  const Stopwatch clock;
  try {
    panels = large_array(static_cast<size_t>(report.entries));
    const PermutedMatrix matrix = permuted(tree, lower, scale, coupling);
    const FrontKernel kernel = [&](int32_t s, const Front& front) {
      const int failed = eliminate_definite(front);
      if (failed == 0) return;
      const auto index = static_cast<size_t>(tree.first[s] + failed - 1);
      const int64_t column = tree.order[index];
      throw NotPositiveDefinite(
          fmt::format("matrix is not positive definite: factorisation stopped at column {}",
                      column),
          column);
    };
    eliminate(tree, matrix, kernel, panels.get(), tree.boundary > 0 ? &boundary_part : nullptr);
    boundary_part = -boundary_part;
  } catch (const std::bad_alloc&) {
    throw NumericsError("out of memory while factorising the matrix");
  }
  report.factor_seconds = clock.seconds();
}

void SupernodalFactor::Impl::check_pivots(const FactorOptions& options) {
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    const double* panel = panels.get() + tree.panel_start[s];
    for (int64_t j = 0; j < tree.columns(s); ++j) {
      const double pivot = panel[j * (tree.height(s) + 1)];
      least = std::min(least, pivot);
      largest = std::max(largest, pivot);
    }
  }
  report.rcond = std::pow(least / largest, 2);
  if (report.rcond >= options.min_rcond) return;
  throw NotPositiveDefinite(
      fmt::format("matrix is singular to working precision: ratio of pivots {:.1e} < {:.1e}",
                  report.rcond, options.min_rcond),
      -1);
}

/// An undetected singular matrix maps the component of b in its null space, about 1/sqrt(n) of it,
/// to a huge x: the residual is then not small, or x as large as rounding allows.
void SupernodalFactor::Impl::probe(const SparseMatrix& lower, const FactorOptions& options) {
  constexpr double kSmallResidual = 1e-10;
  const auto n = lower.rows();
  const Eigen::Map<const Eigen::VectorXd> s(scale.data(), n);
  const Eigen::VectorXd b = random_vector(n);  // all rows of the scaled matrix have equal weight
  const Eigen::VectorXd rhs = b.cwiseQuotient(s);
  const Eigen::MatrixXd x = solve(rhs);
  const Eigen::VectorXd r = rhs - lower.selfadjointView<Eigen::Lower>() * x.col(0);
  report.probe_residual = r.cwiseProduct(s).norm() / b.norm();
  // The largest diagonal entry of the scaled matrix lies in [1/2, 2]; a sufficient estimate of |A|.
  report.probe_condition = x.col(0).cwiseQuotient(s).norm() / b.norm();
  const double rounding = 100.0 * std::numeric_limits<double>::epsilon() * report.probe_condition;
  if (report.probe_condition <= options.max_condition &&
      report.probe_residual <= std::max(kSmallResidual, rounding)) {
    return;
  }
  throw NotPositiveDefinite(
      fmt::format("matrix is singular to working precision: a random solve has residual {:.1e} and "
                  "grows by {:.1e}",
                  report.probe_residual, report.probe_condition),
      -1);
}

/// Row-major blocks of columns of b in elimination order; `use` gets each block (with space for the
/// boundary after it), its width and its first column.
template <class Use>
void SupernodalFactor::Impl::by_blocks(const Eigen::Ref<const Eigen::MatrixXd>& b,
                                       Use&& use) const {
  const Index n = tree.size, block = std::min(kBlock, whole_lanes(b.cols()));
  const std::unique_ptr<double[]> work =
      large_array(static_cast<size_t>((n + tree.boundary) * block));
  for (Index first = 0; first < b.cols(); first += block) {
    const Index used = std::min(block, b.cols() - first), count = whole_lanes(used);
    parallel_pieces(n, [&](int64_t begin, int64_t end) {
      for (int64_t j = begin; j < end; ++j) {
        const Index i = tree.order[j];
        double* row = work.get() + j * count;
        for (Index c = 0; c < used; ++c) row[c] = b(i, first + c);
        std::fill(row + used, row + count, 0.0);
      }
    });
    use(work.get(), count, first, used);
  }
}

Eigen::MatrixXd SupernodalFactor::Impl::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  Eigen::MatrixXd x(b.rows(), b.cols());
  prefer_large_pages(x.data(), static_cast<size_t>(x.size()) * sizeof(double));
  by_blocks(b, [&](double* work, Index count, Index first, Index used) {
    sweeps.solve(view(), scale, work, static_cast<int>(count));
    parallel_pieces(tree.size, [&](int64_t begin, int64_t end) {
      for (int64_t j = begin; j < end; ++j) {
        const Index i = tree.order[j];
        const double* row = work + j * count;
        for (Index c = 0; c < used; ++c) x(i, first + c) = row[c];
      }
    });
  });
  return x;
}

Eigen::MatrixXd SupernodalFactor::Impl::boundary_product(
    const Eigen::Ref<const Eigen::MatrixXd>& f) const {
  Eigen::MatrixXd out(tree.boundary, f.cols());
  by_blocks(f, [&](double* work, Index count, Index first, Index used) {
    double* end = work + int64_t{tree.size} * count;
    std::fill_n(end, tree.boundary * count, 0.0);
    sweeps.forward_to_boundary(view(), scale, work, static_cast<int>(count));
    out.middleCols(first, used) =
        -Eigen::Map<const RowMatrix>(end, tree.boundary, count).leftCols(used);
  });
  return out;
}

SupernodalFactor::SupernodalFactor(const SparseMatrix& lower, const FactorOptions& options)
    : SupernodalFactor(lower, SparseMatrix(), options) {}

SupernodalFactor::SupernodalFactor(const SparseMatrix& lower, const SparseMatrix& coupling,
                                   const FactorOptions& options)
    : impl_(std::make_unique<Impl>()) {
  impl_->scale = power_of_two_scale(lower);
  impl_->tree = analyse_tree(lower, {options.ordering, options.permutation}, coupling);
  impl_->sweeps = TreeSweeps(impl_->tree, thread_count());
  impl_->report = report_of(impl_->tree, lower);
  refuse_if_too_large(impl_->report, options);
  impl_->factorise(lower, coupling);
  impl_->check_pivots(options);
  impl_->probe(lower, options);
}

FactorReport SupernodalFactor::predict(const SparseMatrix& lower, const FactorOptions& options) {
  return report_of(analyse_tree(lower, {options.ordering, options.permutation}), lower);
}

SupernodalFactor::~SupernodalFactor() = default;
SupernodalFactor::SupernodalFactor(SupernodalFactor&&) noexcept = default;
SupernodalFactor& SupernodalFactor::operator=(SupernodalFactor&&) noexcept = default;

Eigen::MatrixXd SupernodalFactor::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  return impl_->solve(b);
}

void SupernodalFactor::solve_in_order(double* x, int count) const {
  const auto sweep = [&](double* rows, Index width) {
    impl_->sweeps.solve(view(), impl_->scale, rows, static_cast<int>(width));
  };
  if (count == whole_lanes(count)) return sweep(x, count);
  const Index n = size(), padded_count = whole_lanes(count);
  RowMatrix padded = RowMatrix::Zero(n, padded_count);
  Eigen::Map<RowMatrix> given(x, n, count);
  padded.leftCols(count) = given;
  sweep(padded.data(), padded_count);
  given = padded.leftCols(count);
}

Eigen::MatrixXd SupernodalFactor::boundary_product(
    const Eigen::Ref<const Eigen::MatrixXd>& f) const {
  return impl_->boundary_product(f);
}

int64_t SupernodalFactor::size() const { return impl_->tree.size; }
const FactorReport& SupernodalFactor::report() const { return impl_->report; }
std::vector<int64_t> SupernodalFactor::permutation() const {
  return {impl_->tree.order.begin(), impl_->tree.order.end()};
}
const Eigen::MatrixXd& SupernodalFactor::boundary_part() const { return impl_->boundary_part; }
const SupernodeTree& SupernodalFactor::tree() const { return impl_->tree; }
const std::vector<double>& SupernodalFactor::scale() const { return impl_->scale; }
FactorView SupernodalFactor::view() const { return impl_->view(); }

}  // namespace clatter::sparse
