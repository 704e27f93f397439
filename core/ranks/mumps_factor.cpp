// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/mumps_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <random>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/stopwatch.hpp"
#include "core/ranks/factor_folder.hpp"
#include "core/ranks/mumps_impl.hpp"

namespace clatter::ranks {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kColumns = 64;  // right-hand sides of a solve
constexpr double kMegabytesPerGib = 1024.0 * 1024.0 * 1024.0 / 1e6;

/// Memory that each rank may take [GiB], the same on all.
double memory_of_a_rank(const Ranks& ranks, const sparse::FactorOptions& options) {
  if (options.memory_limit_gib > 0.0) return options.memory_limit_gib;
  return ranks.least(memory_left_gib());
}

}  // namespace

struct MumpsFactor::Impl {
  Impl(const Ranks& all, const RowShares& rows, Extent part)
      : ranks(all), shares(rows), extent(part), mumps(all, Definite::kYes) {}

  void analyse(const sparse::FactorOptions& options);
  void factorise_all();
  void check_pivots(const sparse::FactorOptions& options);
  void take_schur();
  /// x <- A^{-1} x, columns of the own rows; with `forward` only the reduced right-hand sides.
  void run_solve(const MatrixXd& rhs, bool forward);
  void take_solution(MatrixXd& x, Index count);
  MatrixXd solve(const Eigen::Ref<const MatrixXd>& b);

  /// Gives MUMPS the folder of its files.
  void use_disk();

  const Ranks& ranks;
  RowShares shares;  // a copy: small
  Extent extent;
  std::unique_ptr<FactorFolder> folder;  // outlives the instance, which removes its files first
  MumpsInstance mumps;
  Triplets triplets;
  std::vector<MUMPS_INT> order, schur_rows, rhs_rows, solution_rows;
  std::vector<double> schur, rhs, solution, reduced;
  std::vector<int64_t> solved;  // rows of the solution that are not boundary ones
  std::unique_ptr<RowExchange> home;
  VectorXd scale;
  MatrixXd boundary_part;
  sparse::FactorReport report;
  bool on_disk = false;
};

void MumpsFactor::Impl::analyse(const sparse::FactorOptions& options) {
  const Stopwatch clock;
  const bool coupled = extent == Extent::kInteriorToBoundary;
  const int64_t size = extent == Extent::kInterior ? shares.interior() : shares.size();
  give_matrix(mumps, triplets, order, size);
  if (coupled) {
    require_schur_counts(mumps, shares.boundary());
    schur_rows.resize(shares.boundary());
    std::iota(schur_rows.begin(), schur_rows.end(), static_cast<MUMPS_INT>(shares.interior() + 1));
    if (ranks.rank() == 0) schur.resize(schur_rows.size() * schur_rows.size());
    mumps.icntl(19) = 1;
    mumps.data().size_schur = static_cast<MUMPS_INT>(schur_rows.size());
    mumps.data().listvar_schur = schur_rows.data();
    mumps.data().schur = schur.data();
  }
  mumps.run(kAnalyse);
  if (mumps.infog(1) < 0) fail(mumps, "analysis");
  report.size = coupled ? shares.interior() : size;
  report.entries = mumps.count(20);
  report.flops = mumps.rinfog(1);
  report.ordering = "metis";
  report.predicted_gib = static_cast<double>(mumps.infog(16)) / kMegabytesPerGib;
  const double from_disk = static_cast<double>(mumps.infog(26)) / kMegabytesPerGib;
  const double left = memory_of_a_rank(ranks, options);
  on_disk = report.predicted_gib > left;
  if (on_disk && from_disk > left) {
    mumps.end();
    throw NumericsError(fmt::format(
        "the factor of {} unknowns needs {} of each of {} ranks ({} entries), {} with the factor "
        "on disk, {} are left: use more ranks or raise the limit (--memory-limit)",
        report.size, memory_text(report.predicted_gib), ranks.size(), report.entries,
        memory_text(from_disk), memory_text(left)));
  }
  if (on_disk)
    say(fmt::format("the factor needs {} of each rank, {} are left: it is kept on disk",
                    memory_text(report.predicted_gib), memory_text(left)));
  mumps.icntl(22) = on_disk ? 1 : 0;
  if (on_disk) use_disk();
  report.analyse_seconds = clock.seconds();
}

void MumpsFactor::Impl::use_disk() {
  folder = std::make_unique<FactorFolder>();
  DMUMPS_STRUC_C& data = mumps.data();
  const std::string path = folder->path().string(), prefix = "factor";
  if (path.size() >= sizeof(data.ooc_tmpdir))
    throw FileError(
        fmt::format("{}: found a path of {} characters (TMPDIR), expected fewer than {}", path,
                    path.size(), sizeof(data.ooc_tmpdir)));
  std::copy_n(path.c_str(), path.size() + 1, data.ooc_tmpdir);
  std::copy_n(prefix.c_str(), prefix.size() + 1, data.ooc_prefix);
  // A buffer that the rank writes itself. The default of MUMPS, 4, leaves that to a thread, which
  // ends when a disk is full, while the rank may wait for it without end (mumps_io_thread.c, 5.5).
  constexpr int kWriteStrategy = 99;
  data.keep[kWriteStrategy - 1] = 3;
}

void MumpsFactor::Impl::factorise_all() {
  const Stopwatch clock;
  factorise(mumps, "factorisation");
  triplets = {};
  report.factor_seconds = clock.seconds();
  if (mumps.infog(12) == 0) return;
  const MUMPS_INT negative = mumps.infog(12);
  mumps.end();
  throw sparse::NotPositiveDefinite(
      fmt::format("matrix is not positive definite: {} negative pivots", negative), -1);
}

void MumpsFactor::Impl::check_pivots(const sparse::FactorOptions& options) {
  report.rcond = mumps.rinfog(20) / mumps.rinfog(21);
  if (report.rcond >= options.min_rcond) return;
  mumps.end();
  throw sparse::NotPositiveDefinite(
      fmt::format("matrix is singular to working precision: ratio of pivots {:.1e} < {:.1e}",
                  report.rcond, options.min_rcond),
      -1);
}

void MumpsFactor::Impl::take_schur() {
  const Index n_b = shares.boundary();
  boundary_part.resize(n_b, n_b);
  if (ranks.rank() == 0) {
    const Eigen::Map<const RowMatrix> lower(schur.data(), n_b, n_b);
    boundary_part = -MatrixXd(lower.selfadjointView<Eigen::Lower>());
  }
  schur = {};
  ranks.agree(boundary_part.data(), boundary_part.size());
}

void MumpsFactor::Impl::run_solve(const MatrixXd& b, bool forward) {
  DMUMPS_STRUC_C& data = mumps.data();
  const Index rows = scale.size(), count = b.cols();
  if (rhs_rows.empty()) {
    for (const int64_t row : shares.rows_of(ranks.rank(), extent == Extent::kWhole))
      rhs_rows.push_back(static_cast<MUMPS_INT>(row + 1));
    solution_rows.resize(std::max(data.info[22], 1));
  }
  rhs.resize(std::max<Index>(rows * count, 1));
  Eigen::Map<MatrixXd>(rhs.data(), rows, count) = scale.asDiagonal() * b;
  mumps.icntl(20) = 10;
  mumps.icntl(21) = 1;
  mumps.icntl(26) = forward ? 1 : 0;
  mumps.icntl(27) = static_cast<MUMPS_INT>(count);
  data.nrhs = static_cast<MUMPS_INT>(count);
  data.nloc_rhs = data.lrhs_loc = static_cast<MUMPS_INT>(rows);
  if (rows == 0) data.lrhs_loc = 1;
  data.irhs_loc = rhs_rows.data();
  data.rhs_loc = rhs.data();
  data.lsol_loc = std::max(data.info[22], 1);
  solution.resize(static_cast<size_t>(data.lsol_loc) * static_cast<size_t>(count));
  data.sol_loc = solution.data();
  data.isol_loc = solution_rows.data();
  const Index n_b = shares.boundary();
  if (forward) {
    reduced.assign(ranks.rank() == 0 ? n_b * count : 1, 0.0);
    data.redrhs = reduced.data();
    data.lredrhs = static_cast<MUMPS_INT>(n_b);
  }
  mumps.run(kSolve);
  if (mumps.infog(1) < 0) fail(mumps, "solve");
}

void MumpsFactor::Impl::take_solution(MatrixXd& x, Index count) {
  const Index given = mumps.data().lsol_loc;
  if (!home) {
    const int64_t last = extent == Extent::kWhole ? shares.size() : shares.interior();
    std::vector<int64_t> wanted;
    for (MUMPS_INT k = 0; k < mumps.data().info[22]; ++k) {
      const int64_t row = solution_rows[k] - 1;
      if (row >= last) continue;
      wanted.push_back(row);
      solved.push_back(k);
    }
    home = std::make_unique<RowExchange>(ranks, shares, wanted);
  }
  RowMatrix from(static_cast<Index>(solved.size()), count), to(x.rows(), count);
  const Eigen::Map<const MatrixXd> values(solution.data(), given, count);
  from = values(solved, Eigen::all);
  home->deliver(from.data(), to.data(), static_cast<int>(count));
  x = scale.asDiagonal() * to;
}

MatrixXd MumpsFactor::Impl::solve(const Eigen::Ref<const MatrixXd>& b) {
  MatrixXd x(b.rows(), b.cols()), part(b.rows(), 0);
  for (Index first = 0; first < b.cols(); first += kColumns) {
    const Index count = std::min(kColumns, b.cols() - first);
    run_solve(b.middleCols(first, count), false);
    take_solution(part, count);
    x.middleCols(first, count) = part;
  }
  return x;
}

MumpsFactor::MumpsFactor(const Ranks& ranks, const RowShares& shares, const ShiftedEntries& entries,
                         Extent extent, const sparse::FactorOptions& options)
    : impl_(std::make_unique<Impl>(ranks, shares, extent)) {
  ScaledTriplets scaled = scaled_triplets(ranks, shares, entries, extent);
  impl_->triplets = std::move(scaled.triplets);
  impl_->scale = std::move(scaled.scale);
  impl_->analyse(options);
  impl_->factorise_all();
  impl_->check_pivots(options);
  if (extent == Extent::kInteriorToBoundary) impl_->take_schur();
}

MumpsFactor::~MumpsFactor() = default;

MatrixXd MumpsFactor::solve(const Eigen::Ref<const MatrixXd>& b) const { return impl_->solve(b); }

void MumpsFactor::solve_in_order(double* x, int count) const {
  Eigen::Map<RowMatrix> rows(x, impl_->scale.size(), count);
  rows = impl_->solve(MatrixXd(rows));
}

MatrixXd MumpsFactor::boundary_product(const Eigen::Ref<const MatrixXd>& f) const {
  const Index n_b = impl_->shares.boundary();
  MatrixXd out(n_b, f.cols());
  for (Index first = 0; first < f.cols(); first += kColumns) {
    const Index count = std::min(kColumns, f.cols() - first);
    impl_->run_solve(f.middleCols(first, count), true);
    if (impl_->ranks.rank() == 0)
      out.middleCols(first, count) = -Eigen::Map<const MatrixXd>(impl_->reduced.data(), n_b, count);
  }
  impl_->ranks.agree(out.data(), out.size());
  return out;
}

void MumpsFactor::probe(const std::function<MatrixXd(const MatrixXd&)>& A,
                        const sparse::FactorOptions& options) {
  constexpr double kSmallResidual = 1e-10;
  const Ranks& ranks = impl_->ranks;
  const VectorXd& scale = impl_->scale;
  std::mt19937_64 engine(20240607 + static_cast<uint64_t>(ranks.rank()));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const VectorXd b = VectorXd::NullaryExpr(scale.size(), [&] { return uniform(engine); });
  const MatrixXd rhs = b.cwiseQuotient(scale);
  const MatrixXd x = solve(rhs), rest = rhs - A(x);
  const double length = ranks.norms(b)[0];
  sparse::FactorReport& report = impl_->report;
  report.probe_residual = ranks.norms(scale.asDiagonal() * rest)[0] / length;
  report.probe_condition = ranks.norms(x.col(0).cwiseQuotient(scale))[0] / length;
  const double rounding = 100.0 * std::numeric_limits<double>::epsilon() * report.probe_condition;
  if (report.probe_condition <= options.max_condition &&
      report.probe_residual <= std::max(kSmallResidual, rounding))
    return;
  impl_->mumps.end();
  throw sparse::NotPositiveDefinite(
      fmt::format("matrix is singular to working precision: a random solve has residual {:.1e} and "
                  "grows by {:.1e}",
                  report.probe_residual, report.probe_condition),
      -1);
}

const MatrixXd& MumpsFactor::boundary_part() const { return impl_->boundary_part; }
const sparse::FactorReport& MumpsFactor::report() const { return impl_->report; }
bool MumpsFactor::out_of_core() const { return impl_->on_disk; }

sparse::InertiaCount count_below(const Ranks& ranks, const RowShares& shares, const Entries& K,
                                 const Entries& M, double limit, Extent extent) {
  const Stopwatch clock;
  Triplets triplets = scaled_triplets(ranks, shares, {K, M, limit}, extent).triplets;
  std::vector<MUMPS_INT> order;
  const int64_t size = extent == Extent::kWhole ? shares.size() : shares.interior();
  MumpsInstance mumps(ranks, Definite::kNo);
  give_matrix(mumps, triplets, order, size);
  mumps.icntl(13) = 1;  // inertia of the root as well
  mumps.icntl(24) = 1;  // report null pivots
  mumps.icntl(31) = 1;  // discard the factor
  mumps.run(kAnalyse);
  if (mumps.infog(1) < 0) fail(mumps, "analysis of the inertia count");
  factorise(mumps, "factorisation of the inertia count");
  sparse::InertiaCount count;
  count.negative = mumps.infog(12);
  count.zero = mumps.infog(28);
  count.by_mumps = true;
  count.seconds = clock.seconds();
  return count;
}

}  // namespace clatter::ranks
