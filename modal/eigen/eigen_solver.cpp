#include "modal/eigen/eigen_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/stopwatch.hpp"
#include "core/threads.hpp"
#include "modal/eigen/amls.hpp"
#include "modal/eigen/arpack_solver.hpp"
#include "modal/eigen/block_lanczos.hpp"
#include "modal/eigen/dense_solver.hpp"
#include "modal/eigen/mode_check.hpp"
#include "modal/eigen/mode_density.hpp"
#include "modal/eigen/refinement.hpp"
#include "modal/factor/inertia.hpp"
#include "modal/symmetric_product.hpp"

namespace clatter::modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSameValue = 1e-7;  // relative distance at which two values count as one
constexpr int kMaxRefinements = 2;
constexpr int kExtra = 3;  // modes beyond the wanted, to find a gap behind them

/// The problem with all that one request needs.
class Search {
 public:
  Search(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
         const SupernodalFactor* factor);
  ModeSet run();

 private:
  bool small() const { return n_ <= options_.dense_limit; }
  /// Frequencies with an estimated error in place of a residual at rounding.
  bool approximate() const { return modes_.errors.size() > 0; }
  EigenResult attempt(int count, int retry);
  EigenResult solve(int count, int retry);
  /// Values below a limit that stands in a gap, with the inertia count there.
  void prove(double limit);
  void find_by_count();
  void find_by_limit();
  void find_by_limit_unproved(double limit);
  /// Solves for `count` modes until as many lie below `limit` as the proof says.
  void match_proof(int count);
  void take(EigenResult&& found);
  /// Values that the true ones are not below, as far as the errors are known.
  VectorXd lower_values() const;
  /// As many values below the limit as inertia counts there.
  bool agrees() const;
  /// So many may be, by the errors of the values: no contradiction, and no proof.
  bool may_agree() const;
  void keep_first(Index count);
  /// The factor of K - sigma M; made anew when AMLS gave its memory back.
  const SupernodalFactor& factor();
  /// About how many modes lie below a value.
  int estimated_below(double limit);
  void finish();

  const SparseMatrix& K_;
  const SparseMatrix& M_;
  const EigenOptions& options_;
  const Index n_;
  const SupernodalFactor* const given_factor_;
  std::unique_ptr<SupernodalFactor> own_factor_;
  std::vector<int64_t> order_;  // unknown at each place: inside, rows stand in the factor's order
  std::optional<SymmetricProduct> mass_;
  ShiftInvert problem_;
  ModeSet modes_;
};

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

Index values_below(const VectorXd& values, double limit) {
  return (values.array() < limit).count();
}

Search::Search(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
               const SupernodalFactor* factor)
    : K_(K), M_(M), options_(options), n_(K.rows()), given_factor_(factor) {
  modes_.sigma = options.sigma ? *options.sigma : default_shift(K, M);
  order_.resize(static_cast<size_t>(n_));
  std::iota(order_.begin(), order_.end(), 0);
  if (small()) {
    mass_.emplace(M);
    return;
  }
  modes_.factor = this->factor().report();
  problem_.size = n_;
  problem_.sigma = modes_.sigma;
  order_ = this->factor().permutation();
  mass_.emplace(reordered(M, order_));
  problem_.solve = [this](const double* x, double* y, int count) {
    parallel_pieces(n_ * count,
                    [&](int64_t begin, int64_t end) { std::copy(x + begin, x + end, y + begin); });
    this->factor().solve_in_order(y, count);
  };
  problem_.mass = [this](const double* x, double* y, int count) { mass_->multiply(x, y, count); };
}

const SupernodalFactor& Search::factor() {
  if (given_factor_ != nullptr) return *given_factor_;
  if (!own_factor_) {  // the same order each time
    const SparseMatrix shifted = K_ - modes_.sigma * M_;
    own_factor_ = std::make_unique<SupernodalFactor>(shifted, options_.factor);
  }
  return *own_factor_;
}

EigenResult Search::attempt(int count, int retry) {
  const uint64_t seed = options_.seed + 7919 * static_cast<uint64_t>(retry);
  const int block_room = 2 * count + 6 * 24;
  const bool given_start = retry == 0 && options_.start.size() == n_;
  if (options_.method == EigenMethod::kAmls && block_room < n_) {
    AmlsOptions amls;
    amls.count = count;
    amls.accuracy = options_.accuracy;
    amls.cutoff = options_.amls_cutoff * std::pow(1.5, retry);
    amls.seed = seed;
    return solve_amls(problem_, factor(), *mass_, amls);
  }
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
    const bool fell_back = options_.method == EigenMethod::kAmls && found.errors.size() == 0;
    modes_.method = name_of(fell_back ? EigenMethod::kArpack : options_.method);
  }
  modes_.solves += found.solves;
  modes_.seconds += clock.seconds();
  if (!found.ok()) throw NumericsError("modes: " + found.message);
  // The vectors of AMLS need no more solves; their memory is wanted for the count.
  if (found.errors.size() > 0) own_factor_.reset();
  return found;
}

void Search::take(EigenResult&& found) {
  modes_.values = std::move(found.values);
  modes_.vectors = std::move(found.vectors);
  modes_.errors = std::move(found.errors);
}

VectorXd Search::lower_values() const {
  constexpr double kEstimates = 4.0;  // a value errs by two errors of its frequency; twice that
  if (modes_.errors.size() == 0) return modes_.values;
  return modes_.values.array() - kEstimates * modes_.errors.array() * modes_.values.array().abs();
}

bool Search::agrees() const {
  return values_below(modes_.values, modes_.proof.limit) == modes_.proof.below;
}

bool Search::may_agree() const {
  const double limit = modes_.proof.limit;
  return approximate() && values_below(modes_.values, limit) <= modes_.proof.below &&
         values_below(lower_values(), limit) >= modes_.proof.below;
}

void Search::prove(double limit) {
  modes_.proof.limit = limit;
  if (!options_.prove_count) return;
  const InertiaCount count = count_below(K_, M_, limit, small() ? std::vector<int64_t>{} : order_);
  modes_.proof.seconds += count.seconds;
  if (count.zero > 0) {
    throw NumericsError(fmt::format("modes: {:.6g} Hz is an eigenfrequency; ask for another limit",
                                    hz_of_value(limit)));
  }
  modes_.proof.below = count.negative;
}

void Search::match_proof(int count) {
  for (int retry = modes_.retries;; ++retry) {
    modes_.retries = retry;
    take(solve(count, retry));
    if (!options_.prove_count) return;
    const Index below = values_below(modes_.values, modes_.proof.limit);
    modes_.proof.proved = agrees();
    if (modes_.proof.proved || may_agree()) return;
    const std::string mismatch =
        fmt::format("inertia counts {} modes below {:.6g} Hz, the solver found {}",
                    modes_.proof.below, hz_of_value(modes_.proof.limit), below);
    if (retry >= options_.max_retries) throw NumericsError("modes: " + mismatch);
    warn(mismatch + "; searching again from a new start");
  }
}

/// The widest relative gap after the first `count` values: {values before it, limit inside it}.
/// @param lower what the true values are not below.
std::pair<Index, double> widest_gap(const VectorXd& values, const VectorXd& lower, Index count,
                                    double scale) {
  Index best = count;
  double width = -1.0, limit = 0.0;
  for (Index j = count; j < values.size(); ++j) {
    const double here = (lower[j] - values[j - 1]) / (std::abs(values[j]) + scale);
    if (here <= width) continue;
    best = j;
    width = here;
    limit = 0.5 * (lower[j] + values[j - 1]);
  }
  if (width < kSameValue) return {values.size(), 0.0};
  return {best, limit};
}

void Search::find_by_count() {
  const auto all = static_cast<int>(n_);
  for (int extra = kExtra;; extra *= 4) {
    const int asked = std::min(options_.count + extra, all);
    take(solve(asked, modes_.retries));
    const VectorXd& values = modes_.values;
    if (values.size() <= options_.count) {  // the whole spectrum: nothing can be missing
      modes_.proof = {true, values.tail(1)[0], values.size(), 0.0};
      break;
    }
    const auto [before, limit] =
        widest_gap(values, lower_values(), options_.count, 1e-6 * std::abs(modes_.sigma));
    const bool found_gap = before < values.size();
    if (!found_gap && asked < all && !approximate()) continue;  // a cluster: look further
    modes_.next_value = lower_values()[options_.count];
    if (!found_gap && approximate()) break;  // the errors leave no gap: nothing can be proved
    prove(limit);
    if (options_.prove_count && !agrees()) {
      ++modes_.retries;
      if (modes_.retries > options_.max_retries) {
        throw NumericsError(
            fmt::format("modes: inertia counts {} modes below {:.6g} Hz, the solver found {}",
                        modes_.proof.below, hz_of_value(limit), before));
      }
      warn("a mode is missing; searching again from a new start");
      match_proof(static_cast<int>(std::min<Index>(n_, modes_.proof.below + kExtra)));
    }
    modes_.proof.proved = options_.prove_count && agrees();
    break;
  }
  keep_first(options_.count);
}

int Search::estimated_below(double limit) {
  const ModeDensity density(SubtreeProduct(factor(), *mass_), n_, options_.seed);
  modes_.solves += ModeDensity::kSolves;
  return static_cast<int>(density.count_above(1.0 / (limit - modes_.sigma)));
}

void Search::find_by_limit_unproved(double limit) {
  constexpr int kMore = 20;  // than estimated: what a first guess may lack of few modes
  int count = kMore + (small() ? 0 : estimated_below(limit));
  for (;; count += count / 2) {
    const int asked = static_cast<int>(std::min<Index>(count, n_));
    take(solve(asked, 0));
    if (modes_.values.tail(1)[0] >= limit || asked == n_ || modes_.values.size() < asked) return;
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
  // The count knows the number; the errors may have lifted some over the limit.
  const bool counted = options_.prove_count && may_agree();
  const Index kept = counted ? modes_.proof.below : values_below(modes_.values, limit);
  if (!counted && approximate() && kept < modes_.values.size())
    modes_.next_value = std::min(limit, lower_values()[kept]);
  keep_first(kept);
}

void Search::keep_first(Index count) {
  modes_.values.conservativeResize(count);
  if (approximate()) modes_.errors.conservativeResize(count);
  modes_.vectors.conservativeResize(n_, count);
}

void Search::finish() {
  {
    const SymmetricProduct stiffness(reordered(K_, order_));
    const auto measure = [&] { modes_.residuals = residuals_of(stiffness, *mass_, modes_); };
    measure();
    for (int k = 0; k < kMaxRefinements && !small() && !approximate() && modes_.size() > 0 &&
                    !(modes_.residuals.maxCoeff() <= options_.max_residual);
         ++k) {
      // What the factor weakens most, motion of high frequency left in the vectors, is what their
      // residuals show most.
      refine_modes(problem_, *mass_, modes_.vectors, modes_.values);
      modes_.solves += modes_.size();
      measure();
    }
  }
  if (!approximate()) refuse_residuals(modes_, options_.max_residual);
  present(order_, modes_);
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

ModeSet solve_modes(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
                    const SupernodalFactor* factor) {
  check_request(K, M, options);
  return Search(K, M, options, factor).run();
}

}  // namespace clatter::modal
