#include "modal/eigen/eigen_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/stopwatch.hpp"
#include "core/threads.hpp"
#include "modal/dense_eigen.hpp"
#include "modal/dense_product.hpp"
#include "modal/eigen/arpack_solver.hpp"
#include "modal/eigen/block_lanczos.hpp"
#include "modal/eigen/dense_solver.hpp"
#include "modal/factor/inertia.hpp"
#include "modal/symmetric_product.hpp"

namespace clatter::modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRigidRatio = 1e-6;  // |f| < 1e-3 of the first elastic frequency
constexpr double kSameValue = 1e-7;   // relative distance at which two values count as one
constexpr int kMaxRefinements = 2;
constexpr Index kColumns = 64;  // of vectors that are handled at a time
constexpr Index kRows = 2048;   // the same
constexpr int kExtra = 3;       // modes beyond the wanted, to find a gap behind them

/// The problem with all that one request needs.
class Search {
 public:
  Search(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
         const SupernodalFactor* factor);
  ModeSet run();

 private:
  bool small() const { return n_ <= options_.dense_limit; }
  EigenResult attempt(int count, int retry) const;
  EigenResult solve(int count, int retry);
  /// Values below a limit that stands in a gap, with the inertia count there.
  void prove(double limit);
  void find_by_count();
  void find_by_limit();
  void find_by_limit_unproved(double limit);
  /// Solves for `count` modes until as many lie below `limit` as the proof says.
  void match_proof(int count);
  void keep_first(Index count);
  void measure_residuals(const SymmetricProduct& stiffness);
  /// One step of subspace iteration with Rayleigh-Ritz: what the factor weakens most, motion of
  /// high frequency left in the vectors, is what their residuals show most.
  void refine();
  void restore_order();
  void finish();

  const SparseMatrix& K_;
  const SparseMatrix& M_;
  const EigenOptions& options_;
  const Index n_;
  const SupernodalFactor* factor_;
  std::unique_ptr<SupernodalFactor> own_factor_;
  std::vector<int64_t> order_;  // unknown at each place: inside, rows stand in the factor's order
  std::optional<SymmetricProduct> mass_;
  ShiftInvert problem_;
  ModeSet modes_;
};

/// P A P^T of a symmetric matrix by its lower triangle: row j of it is row order[j] of A.
SparseMatrix reordered(const SparseMatrix& lower, const std::vector<int64_t>& order) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> place(lower.cols());
  for (size_t j = 0; j < order.size(); ++j)
    place.indices()[static_cast<Index>(order[j])] = static_cast<int>(j);
  SparseMatrix out(lower.rows(), lower.cols());
  out.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(place);
  return out;
}

void check_request(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options) {
  if ((options.count > 0) == (options.fmax_hz > 0.0) || options.count < 0 ||
      !std::isfinite(options.fmax_hz)) {
    throw InputError(fmt::format(
        "modes: found count = {} and fmax_hz = {}, expected exactly one of them to be positive",
        options.count, options.fmax_hz));
  }
  if (K.rows() != M.rows() || K.rows() == 0) {
    throw InputError(fmt::format("modes: K has {} rows and M {}", K.rows(), M.rows()));
  }
  if (options.count > K.rows()) {
    throw InputError(fmt::format("modes: found count = {}, expected at most {} (the unknowns)",
                                 options.count, K.rows()));
  }
}

Search::Search(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
               const SupernodalFactor* factor)
    : K_(K), M_(M), options_(options), n_(K.rows()), factor_(factor) {
  modes_.sigma = options.sigma ? *options.sigma : default_shift(K, M);
  order_.resize(static_cast<size_t>(n_));
  std::iota(order_.begin(), order_.end(), 0);
  if (small()) {
    mass_.emplace(M);
    return;
  }
  if (factor_ == nullptr) {
    const SparseMatrix shifted = K - modes_.sigma * M;
    own_factor_ = std::make_unique<SupernodalFactor>(shifted, options.factor);
    factor_ = own_factor_.get();
  }
  modes_.factor = factor_->report();
  problem_.size = n_;
  problem_.sigma = modes_.sigma;
  order_ = factor_->permutation();
  mass_.emplace(reordered(M, order_));
  problem_.solve = [this](const double* x, double* y, int count) {
    std::copy_n(x, n_ * count, y);
    factor_->solve_in_order(y, count);
  };
  problem_.mass = [this](const double* x, double* y, int count) { mass_->multiply(x, y, count); };
}

EigenResult Search::attempt(int count, int retry) const {
  const uint64_t seed = options_.seed + 7919 * static_cast<uint64_t>(retry);
  const bool given_start = retry == 0 && options_.start.size() == n_;
  const int block_room = 2 * count + 6 * 24;
  if (options_.method == EigenMethod::kBlockLanczos && block_room < n_) {
    BlockLanczosOptions block;
    block.count = count;
    block.seed = seed;
    if (given_start) block.start = options_.start(order_);
    return solve_block_lanczos(problem_, block);
  }
  ArpackOptions arpack;
  arpack.count = count;
  arpack.seed = seed;
  arpack.basis =
      static_cast<int>(std::min<Index>(n_, static_cast<Index>((2 + retry)) * count + 10));
  if (given_start) arpack.start = options_.start(order_);
  return solve_arpack(problem_, arpack);
}

EigenResult Search::solve(int count, int retry) {
  const Stopwatch clock;
  EigenResult found;
  if (small()) {
    found = solve_dense(dense_symmetric(K_), dense_symmetric(M_), modes_.sigma, count);
    modes_.method = "dense";
  } else {
    found = attempt(count, retry);
    modes_.method = options_.method == EigenMethod::kArpack ? "arpack" : "block-lanczos";
  }
  modes_.solves += found.solves;
  modes_.seconds += clock.seconds();
  if (!found.ok()) throw NumericsError("modes: " + found.message);
  return found;
}

void Search::prove(double limit) {
  modes_.proof.limit = limit;
  if (!options_.prove_count) return;
  const auto permutation = factor_ ? factor_->permutation() : std::vector<int64_t>{};
  const InertiaCount count = count_below(K_, M_, limit, permutation);
  modes_.proof.seconds += count.seconds;
  if (count.zero > 0) {
    throw NumericsError(fmt::format("modes: {:.6g} Hz is an eigenfrequency; ask for another limit",
                                    hz_of_value(limit)));
  }
  modes_.proof.below = count.negative;
}

Index values_below(const VectorXd& values, double limit) {
  return (values.array() < limit).count();
}

void Search::match_proof(int count) {
  for (int retry = modes_.retries;; ++retry) {
    modes_.retries = retry;
    EigenResult found = solve(count, retry);
    modes_.values = found.values;
    modes_.vectors = std::move(found.vectors);
    if (!options_.prove_count) return;
    const Index below = values_below(found.values, modes_.proof.limit);
    modes_.proof.proved = below == modes_.proof.below;
    if (modes_.proof.proved) return;
    const std::string mismatch =
        fmt::format("inertia counts {} modes below {:.6g} Hz, the solver found {}",
                    modes_.proof.below, hz_of_value(modes_.proof.limit), below);
    if (retry >= options_.max_retries) throw NumericsError("modes: " + mismatch);
    warn(mismatch + "; searching again from a new start");
  }
}

/// The widest relative gap after the first `count` values: {values before it, limit inside it}.
std::pair<Index, double> widest_gap(const VectorXd& values, Index count, double scale) {
  Index best = count;
  double width = -1.0, limit = 0.0;
  for (Index j = count; j < values.size(); ++j) {
    const double here = (values[j] - values[j - 1]) / (std::abs(values[j]) + scale);
    if (here <= width) continue;
    best = j;
    width = here;
    limit = 0.5 * (values[j] + values[j - 1]);
  }
  if (width < kSameValue) return {values.size(), 0.0};
  return {best, limit};
}

void Search::find_by_count() {
  const auto all = static_cast<int>(n_);
  for (int extra = kExtra;; extra *= 4) {
    const int asked = std::min(options_.count + extra, all);
    EigenResult found = solve(asked, modes_.retries);
    modes_.values = found.values;
    modes_.vectors = std::move(found.vectors);
    if (found.values.size() <= options_.count) {  // the whole spectrum: nothing can be missing
      modes_.proof = {true, found.values.tail(1)[0], found.values.size(), 0.0};
      break;
    }
    const auto [before, limit] =
        widest_gap(found.values, options_.count, 1e-6 * std::abs(modes_.sigma));
    if (before == found.values.size() && asked < all) continue;  // a cluster: look further
    modes_.next_value = found.values[options_.count];
    prove(limit);
    if (options_.prove_count && values_below(found.values, limit) != modes_.proof.below) {
      ++modes_.retries;
      if (modes_.retries > options_.max_retries) {
        throw NumericsError(
            fmt::format("modes: inertia counts {} modes below {:.6g} Hz, the solver found {}",
                        modes_.proof.below, hz_of_value(limit), before));
      }
      warn("a mode is missing; searching again from a new start");
      match_proof(static_cast<int>(std::min<Index>(n_, modes_.proof.below + kExtra)));
    }
    modes_.proof.proved = options_.prove_count;
    break;
  }
  keep_first(options_.count);
}

void Search::find_by_limit_unproved(double limit) {
  for (int count = 20;; count = count * 2) {
    const int asked = static_cast<int>(std::min<Index>(count, n_));
    EigenResult found = solve(asked, 0);
    modes_.values = found.values;
    modes_.vectors = std::move(found.vectors);
    if (found.values.tail(1)[0] >= limit || asked == n_ || found.values.size() < asked) return;
  }
}

void Search::find_by_limit() {
  const double limit = value_of_hz(options_.fmax_hz);
  modes_.next_value = limit;
  if (!options_.prove_count || small()) {
    find_by_limit_unproved(limit);
    if (options_.prove_count) {
      prove(limit);
      modes_.proof.proved = values_below(modes_.values, limit) == modes_.proof.below;
    }
    modes_.proof.limit = limit;
  } else {
    prove(limit);
    modes_.proof.proved = modes_.proof.below == 0;
    if (modes_.proof.below > n_ / 2) {
      throw InputError(
          fmt::format("modes: {} of {} modes lie below {:.6g} Hz; expected less than "
                      "half of all",
                      modes_.proof.below, n_, options_.fmax_hz));
    }
    // Some more than wanted: the last copies of a multiple value converge with their neighbours.
    if (modes_.proof.below > 0) match_proof(static_cast<int>(modes_.proof.below) + kExtra);
  }
  keep_first(values_below(modes_.values, limit));
}

void Search::keep_first(Index count) {
  modes_.values.conservativeResize(count);
  modes_.vectors.conservativeResize(n_, count);
}

void Search::measure_residuals(const SymmetricProduct& stiffness) {
  modes_.residuals.resize(modes_.size());
  for (Index first = 0; first < modes_.size(); first += kColumns) {
    const Index count = std::min(kColumns, modes_.size() - first);
    const MatrixXd mass = *mass_ * modes_.vectors.middleCols(first, count);
    const MatrixXd force = stiffness * modes_.vectors.middleCols(first, count);
    for (Index c = 0; c < count; ++c) {
      const double value = modes_.values[first + c];
      modes_.residuals[first + c] = (force.col(c) - value * mass.col(c)).norm() /
                                    (std::abs(value - modes_.sigma) * mass.col(c).norm());
    }
  }
}

void Search::refine() {
  MatrixXd& X = modes_.vectors;  // X <- (K - sigma M)^{-1} M X, block by block in its place
  const Index m = X.cols();
  MatrixXd shifted = MatrixXd::Zero(m, m), mass = shifted;  // upper triangles of the projections
  RowMatrix image(n_, kColumns), answer(n_, kColumns);
  for (Index first = 0; first < m; first += kColumns) {
    const Index count = std::min(kColumns, m - first), end = first + count;
    image.setZero();
    image.leftCols(count) = *mass_ * X.middleCols(first, count);
    problem_.solve(image.data(), answer.data(), static_cast<int>(kColumns));
    X.middleCols(first, count) = answer.leftCols(count);
    shifted.block(0, first, end, count) =
        transposed_product(X.leftCols(end), MatrixXd(image.leftCols(count)));
  }
  for (Index first = 0; first < m; first += kColumns) {
    const Index count = std::min(kColumns, m - first), end = first + count;
    mass.block(0, first, end, count) =
        transposed_product(X.leftCols(end), *mass_ * X.middleCols(first, count));
  }
  const DenseEigen ritz = symmetric_eigen(mass.transpose(), shifted.transpose());
  if (!ritz.ok) throw NumericsError("modes: the refined vectors depend on each other");
  const VectorXd nu = ritz.values.reverse();
  modes_.values = modes_.sigma + nu.array().inverse();
  const MatrixXd to_modes =
      ritz.vectors.rowwise().reverse() * nu.cwiseSqrt().cwiseInverse().asDiagonal();
  parallel_pieces(n_, [&](int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; row += kRows) {
      auto tile = X.middleRows(row, std::min(kRows, end - row));
      tile = (tile * to_modes).eval();
    }
  });
  modes_.solves += m;
}

void Search::restore_order() {
  parallel_pieces(modes_.size(), [&](int64_t begin, int64_t end) {
    VectorXd inside;
    for (int64_t j = begin; j < end; ++j) {
      inside = modes_.vectors.col(j);
      for (Index i = 0; i < n_; ++i)
        modes_.vectors(static_cast<Index>(order_[static_cast<size_t>(i)]), j) = inside[i];
    }
  });
}

void Search::finish() {
  const SymmetricProduct stiffness(reordered(K_, order_));
  measure_residuals(stiffness);
  for (int k = 0; k < kMaxRefinements && !small() && modes_.size() > 0 &&
                  !(modes_.residuals.maxCoeff() <= options_.max_residual);
       ++k) {
    refine();
    measure_residuals(stiffness);
  }
  restore_order();
  for (Index j = 0; j < modes_.size(); ++j) {
    if (!(modes_.residuals[j] <= options_.max_residual)) {
      throw NumericsError(fmt::format(
          "modes: mode {} at {:.6g} Hz has residual {:.1e}, expected "
          "at most {:.1e}",
          j + 1, hz_of_value(modes_.values[j]), modes_.residuals[j], options_.max_residual));
    }
    auto x = modes_.vectors.col(j);
    Index largest = 0;
    x.cwiseAbs().maxCoeff(&largest);
    if (x[largest] < 0.0) x *= -1.0;
  }
  // The first value that is clearly not rigid is the yardstick for those before it.
  const double shift = modes_.sigma < 0.0 ? -modes_.sigma : 0.0;
  double elastic = shift;
  for (Index j = modes_.size() - 1; j >= 0; --j) {
    if (modes_.values[j] > kRigidRatio * shift) elastic = modes_.values[j];
  }
  modes_.rigid = static_cast<int>((modes_.values.array().abs() < kRigidRatio * elastic).count());
}

ModeSet Search::run() {
  if (options_.count > 0) {
    find_by_count();
  } else {
    find_by_limit();
  }
  finish();
  return std::move(modes_);
}

}  // namespace

VectorXd ModeSet::frequencies_hz() const {
  VectorXd hz(values.size());
  for (Index j = 0; j < values.size(); ++j) hz[j] = j < rigid ? 0.0 : hz_of_value(values[j]);
  return hz;
}

double value_of_hz(double hz) { return std::pow(2.0 * std::numbers::pi * hz, 2); }
double hz_of_value(double value) {
  return std::sqrt(std::max(value, 0.0)) / (2.0 * std::numbers::pi);
}

double default_shift(const SparseMatrix& K, const SparseMatrix& M) {
  std::vector<double> ratio;
  ratio.reserve(static_cast<size_t>(K.cols()));
  for (int j = 0; j < K.cols(); ++j) {
    const double m = M.coeff(j, j);
    if (m > 0.0) ratio.push_back(K.coeff(j, j) / m);
  }
  if (ratio.empty()) throw InputError("modes: M has no mass on its diagonal");
  auto middle = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2);
  std::nth_element(ratio.begin(), middle, ratio.end());
  // A body of n unknowns is about n^(1/3) elements long.
  return -0.1 * *middle * std::pow(static_cast<double>(K.cols()), -2.0 / 3.0);
}

ModeSet solve_modes(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
                    const SupernodalFactor* factor) {
  check_request(K, M, options);
  return Search(K, M, options, factor).run();
}

}  // namespace clatter::modal
