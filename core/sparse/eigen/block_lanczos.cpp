// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/block_lanczos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "core/base/blas_kernel.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/progress.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/eigen/krylov_basis.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Larger blocks read the factor less often, smaller ones converge after fewer vectors.
Index default_block(Index wanted, Index size) {
  constexpr Index kSmall = 20000;  // unknowns whose factor stays in the cache
  return size < kSmall || wanted < 12 ? 8 : 16;
}

constexpr uint64_t kSeedStep = 1000003;  // between the random numbers of two processes

Index block_of(const BlockLanczosOptions& options, Index size) {
  const Index requested = options.block > 0 ? options.block : default_block(options.count, size);
  return (requested + kLanes - 1) / kLanes * kLanes;
}

/// Unknowns of all processes, and the most of one.
Index size_of(const ShiftInvert& problem) {
  return static_cast<Index>(problem.team->sum(static_cast<double>(problem.size)));
}
Index largest_part(const ShiftInvert& problem) {
  return static_cast<Index>(-problem.team->least(-static_cast<double>(problem.size)));
}

BasisSize room_left(const BlockLanczosOptions& options, Index block, Index size,
                    const RowTeam& team) {
  const auto ample = static_cast<double>(size) * static_cast<double>(5 * options.count + 8 * block);
  const double left = team.least(memory_left_gib(gib_of_doubles(ample)));
  const double least =
      gib_of_doubles(static_cast<double>(size) * static_cast<double>(3 * block + options.count));
  require_memory(fmt::format("the vectors of {} modes", options.count), least,
                 "request fewer modes");
  const BasisSize room = basis_size(options, block, size, left);
  if (room.storage == Storage::kDisk)
    warn(fmt::format("{} Lanczos vectors of {} unknowns do not fit into {}: they are kept on disk",
                     room.columns, size, memory_text(left)));
  return room;
}

/// State of a run.
class Run {
 public:
  Run(const ShiftInvert& problem, const BlockLanczosOptions& options);
  EigenResult solve();
  /// lambda of the Ritz values of the first blocks; empty when the operator failed.
  VectorXd first_values();

 private:
  void fill_random(Index column);
  void start();
  /// Makes the new block Y_, which is M-orthogonal to the first `begin` columns of V_,
  /// M-orthonormal and fills MY_; returns R with old = new R. Vanishing directions are replaced by
  /// random ones.
  MatrixXd orthonormalise(Index begin);
  /// Y_ -= V V^T M Y_ for the columns [first, last); adds the coefficients to the last rows of H.
  void remove(Index first, Index last, MatrixXd& H);
  void refresh_image() { problem_.mass(Y_.data.get(), MY_.data.get(), static_cast<int>(b_)); }
  bool expand();
  /// False where T is not finite.
  bool project();
  /// lambda of the Ritz values with nu > 0, ascending.
  VectorXd values() const;
  Index converged() const;
  void restart();
  EigenResult result();

  const ShiftInvert& problem_;
  const BlockLanczosOptions& options_;
  const RowTeam& team_;
  Index n_, b_, wanted_;  // n: rows of this process
  BasisSize room_;
  Index limit_;
  Index size_ = 0;    // columns whose image under Op is in T_
  Index local_ = 0;   // columns before this one have no component in Op of the newest block
  TallBlock Y_, MY_;  // newest block, n x b, and M times it
  KrylovBasis V_;     // n x (limit + b): basis, then the newest block
  MatrixXd T_;        // projection of Op
  MatrixXd R_;        // b x b: the residual block is Y_ R
  VectorXd nu_;       // Ritz values, descending
  MatrixXd S_;        // their coordinates in V(:, :size)
  int64_t solves_ = 0;
  bool indefinite_ = false;  // a vector of negative mass was found
  std::mt19937_64 engine_;
};

Run::Run(const ShiftInvert& problem, const BlockLanczosOptions& options)
    : problem_(problem),
      options_(options),
      team_(*problem.team),
      n_(problem.size),
      b_(block_of(options, size_of(problem))),
      wanted_(options.count),
      room_(room_left(options, b_, largest_part(problem), team_)),
      limit_(room_.columns),
      Y_(n_, b_),
      MY_(n_, b_),
      V_(n_, limit_ + b_, room_.storage),
      engine_(options.seed + kSeedStep * static_cast<uint64_t>(team_.rank())) {
  T_ = MatrixXd::Zero(limit_, limit_);
}

void Run::fill_random(Index column) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Index i = 0; i < n_; ++i) Y_.row(i)[column] = uniform(engine_);
}

void Run::start() {
  for (Index c = 0; c < b_; ++c) fill_random(c);
  const Index given = options_.start.rows() == n_ ? std::min(options_.start.cols(), b_) : 0;
  for (Index i = 0; i < n_; ++i)
    for (Index c = 0; c < given; ++c) Y_.row(i)[c] = options_.start(i, c);
  refresh_image();
  (void)orthonormalise(0);
  V_.put(0, Y_);
}

void Run::remove(Index first, Index last, MatrixXd& H) {
  if (first >= last) return;
  const MatrixXd part = team_.sum(V_.coefficients(first, last, MY_));
  V_.subtract(first, part, Y_);
  H.middleRows(first, last - first) += part;
  refresh_image();
}

MatrixXd Run::orthonormalise(Index begin) {
  // Below this ratio of squared lengths, components of earlier vectors left by two passes are no
  // longer small.
  constexpr double kDependent = 1e-8;
  constexpr double kVanished = 1e-20;
  constexpr double kIndefinite = 1e-8;  // rounding leaves less
  MatrixXd R = MatrixXd::Identity(b_, b_);
  bool repeat = true;
  for (int pass = 0; pass < 2 || (repeat && pass < 4); ++pass) {
    const MatrixXd lengths = team_.sum(gram(Y_, MY_));
    indefinite_ = indefinite_ || lengths.diagonal().minCoeff() <
                                     -kIndefinite * lengths.diagonal().cwiseAbs().maxCoeff();
    const VectorXd scale = lengths.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const dense::Eigenpairs eig =
        dense::symmetric_eigen(scale.asDiagonal() * lengths * scale.asDiagonal());
    const VectorXd d = eig.values.cwiseMax(1e-30);
    const MatrixXd to_unit =
        scale.asDiagonal() * eig.vectors * d.cwiseSqrt().cwiseInverse().asDiagonal();
    const MatrixXd from_unit =
        d.cwiseSqrt().asDiagonal() * eig.vectors.transpose() * scale.cwiseInverse().asDiagonal();
    transform(Y_, to_unit);
    transform(MY_, to_unit);
    R = (from_unit * R).eval();
    repeat = d[0] < kDependent * d[b_ - 1];
    for (Index c = 0; c < b_; ++c) {
      if (d[c] > kVanished * d[b_ - 1]) continue;
      fill_random(c);
      R.row(c).setZero();
    }
    if (!repeat) continue;
    refresh_image();
    MatrixXd ignored = MatrixXd::Zero(begin, b_);
    remove(0, begin, ignored);
    remove(0, begin, ignored);
  }
  return R;
}

bool Run::expand() {
  const Index next = size_ + b_;
  problem_.solve(MY_.data.get(), Y_.data.get(), static_cast<int>(b_));
  solves_ += b_;
  if (team_.any(!Y_.finite())) return false;
  refresh_image();
  // Op is symmetric, so the new block is coupled only to the last two (and to the vectors that a
  // restart kept); the second pass removes rounding components of the others. They must not enter
  // T: with thin walls the factor's rounding is not small, and as a coupling it would keep every
  // residual at its own level.
  MatrixXd H = MatrixXd::Zero(next, b_);
  remove(local_, next, H);
  remove(0, next, H);
  H.topRows(local_).setZero();
  T_.block(0, size_, next, b_) = H;
  T_.block(size_, 0, b_, next) = H.transpose();
  R_ = orthonormalise(next);
  V_.put(next, Y_);
  local_ = size_;
  size_ = next;
  return true;
}

bool Run::project() {
  MatrixXd T = T_.topLeftCorner(size_, size_);
  T = (0.5 * (T + T.transpose())).eval();
  // A second thread gains nothing at these sizes, and busy-waits on one of our cores after each
  // call.
  const BlasThreads one(1);
  const dense::Eigenpairs eig = dense::symmetric_eigen(T);
  if (!eig.ok) return false;
  nu_ = eig.values.reverse();
  S_ = eig.vectors.rowwise().reverse();
  team_.agree(nu_.data(), nu_.size());  // processors of two kinds round differently
  team_.agree(S_.data(), S_.size());
  return true;
}

Index Run::converged() const {
  Index count = 0;
  while (count < std::min(wanted_, size_)) {
    const double residual = (R_ * S_.col(count).tail(b_)).norm();
    const double size = std::max(std::abs(nu_[count]), kSpread * std::abs(nu_[0]));
    if (!(residual <= options_.tolerance * size)) break;
    ++count;
  }
  return count;
}

void Run::restart() {
  // Keeps the wanted vectors and some more, whose convergence would otherwise be lost.
  const Index keep = std::min(wanted_ + b_, size_ - b_);
  V_.transform(S_.leftCols(keep));
  V_.put(keep, Y_);
  T_.setZero();
  T_.topLeftCorner(keep, keep) = nu_.head(keep).asDiagonal();
  size_ = keep;
  local_ = 0;
}

EigenResult Run::result() {
  EigenResult out;
  out.values = nu_.head(wanted_).cwiseInverse().array() + problem_.sigma;
  V_.transform(S_.leftCols(wanted_));
  out.vectors = V_.take_columns(wanted_);
  out.status = EigenStatus::kConverged;
  out.solves = solves_;
  return out;
}

VectorXd Run::values() const {
  return nu_.head((nu_.array() > 0.0).count()).cwiseInverse().array() + problem_.sigma;
}

VectorXd Run::first_values() {
  start();
  for (int k = 0; k < kProbeBlocks; ++k)
    if (!expand()) return {};
  return project() ? values() : VectorXd();
}

EigenResult Run::solve() {
  // Rayleigh-Ritz costs size^3: with many modes it is too costly after every block.
  const Index pause = std::max<Index>(1, wanted_ / (8 * b_)) * b_;
  start();
  Progress progress("eigenpairs", static_cast<double>(wanted_));
  EigenResult out;
  for (int restarts = 0; restarts <= options_.max_restarts; ++restarts) {
    Index check_at = wanted_ + b_;
    while (size_ + b_ <= limit_) {
      if (!expand()) {
        out.status = EigenStatus::kOperatorFailed;
        out.message = "the solve returned values that are not finite";
        return out;
      }
      if (indefinite_) {
        out.status = EigenStatus::kFailed;
        out.message = "a vector has negative mass: M is not positive semidefinite";
        return out;
      }
      const bool look = options_.go_on && solves_ == kProbeBlocks * b_;
      if (!look && size_ < check_at && size_ + b_ <= limit_) continue;
      if (!project()) {
        out.status = EigenStatus::kFailed;
        out.message = "the projection is not finite";
        return out;
      }
      if (look && !options_.go_on(values())) {
        out.status = EigenStatus::kStopped;
        out.message = "another shift is needed";
        out.solves = solves_;
        return out;
      }
      check_at = std::max(check_at, size_ + pause);
      const Index done = converged();
      progress.update(static_cast<double>(done));
      if (done >= wanted_) return result();
    }
    restart();
  }
  out.status = EigenStatus::kNotConverged;
  out.message = fmt::format("{} of {} modes converged in {} restarts", converged(), wanted_,
                            options_.max_restarts);
  out.solves = solves_;
  return out;
}

}  // namespace

BasisSize basis_size(const BlockLanczosOptions& options, Index block, Index size, double left_gib) {
  const Index wanted = options.count;
  const auto round_up = [&](Index columns) {
    return std::max<Index>((std::max(columns, wanted + 2 * block) + block - 1) / block, 3) * block;
  };
  const Storage chosen = options.storage.value_or(Storage::kMemory);
  if (options.basis > 0) return {round_up(options.basis), chosen};
  const auto fits = [&](Index columns) {  // with the other blocks and the requested vectors
    return gib_of_doubles(static_cast<double>(size) *
                          static_cast<double>(columns + 3 * block + wanted)) <= left_gib;
  };
  // A restart lowers the polynomial degree, which determines convergence: avoided with few modes.
  constexpr double kSmallGib = 0.25;  // below: cheap vectors, and close spectra need the degree
  const Index roomy = round_up(2 * wanted + 48 * block);
  const bool small =
      gib_of_doubles(static_cast<double>(size) * static_cast<double>(roomy)) < kSmallGib;
  const Index ample =
      std::max(round_up(std::min(6 * wanted, 2 * wanted + 200) + 4 * block), small ? roomy : 0);
  const Index enough = round_up(2 * wanted + 4 * block);
  const Index least = round_up(wanted + wanted / 4 + 4 * block);
  if (options.storage) return {enough, chosen};
  for (const Index columns : {ample, enough, least})
    if (fits(columns)) return {columns, Storage::kMemory};
  return {enough, Storage::kDisk};
}

VectorXd first_ritz_values(const ShiftInvert& problem, uint64_t seed) {
  BlockLanczosOptions options;
  options.count = 1;
  options.block = kLanes;
  options.basis = kProbeBlocks * kLanes;
  options.seed = seed;
  return Run(problem, options).first_values();
}

EigenResult solve_block_lanczos(const ShiftInvert& problem, const BlockLanczosOptions& options) {
  EigenResult refused;
  refused.status = EigenStatus::kBadInput;
  const int64_t size = size_of(problem), block = block_of(options, size);
  if (options.count < 1) {
    refused.message = fmt::format("{} modes requested, expected at least 1", options.count);
    return refused;
  }
  if (2 * int64_t{options.count} + 6 * block > size) {
    refused.message =
        fmt::format("{} modes of {} unknowns are too many for the subspace", options.count, size);
    return refused;
  }
  return Run(problem, options).solve();
}

}  // namespace clatter::sparse
