// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/eigen_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/eigen/massless.hpp"
#include "core/sparse/eigen/mode_check.hpp"
#include "core/sparse/eigen/mode_source.hpp"
#include "core/sparse/eigen/refinement.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSameValue = 1e-7;  // relative distance below which two values count as equal
constexpr int kMaxRefinements = 2;
constexpr int kExtra = 3;  // extra modes, to find a gap after the wanted ones

/// State of one solve_modes() call.
class Search {
 public:
  Search(const MatrixPencil& pencil, const EigenOptions& options, const Factor* factor);
  ModeSet run();

 private:
  bool small() const { return source_.dense(); }
  Index known() const { return source_.rigid().cols(); }
  /// Frequencies have an estimated error instead of a residual at rounding level.
  bool approximate() const { return modes_.errors.size() > 0; }
  /// The lowest `count` modes besides the known ones. Throws NumericsError.
  EigenResult solve(int count, int retry);
  /// Number of known and computed modes below a limit.
  Index below(const VectorXd& values, double limit) const;
  /// Number of values below a limit in a gap, with the inertia count there.
  void prove(double limit);
  void find_by_count();
  void find_by_limit();
  void find_by_limit_unproved(double limit);
  /// Solves for `count` modes until as many lie below `limit` as the proof requires.
  void match_proof(int count);
  void take(EigenResult&& found);
  /// Lower bounds of the exact values, as far as the errors are known.
  VectorXd lower_values() const;
  /// The values below the limit are as many as the inertia count.
  bool agrees() const;
  /// The count is consistent with the errors of the values: no contradiction, but no proof.
  bool may_agree() const;
  void keep_first(Index count);
  /// A residual is above the limit.
  bool worth_refining() const;
  void finish();

  const MatrixPencil& pencil_;
  const EigenOptions& options_;
  const Index n_;      // of the team
  ModeSource source_;  // internally, rows of large problems are in elimination order
  ModeSet modes_;
};

void check_request(const MatrixPencil& pencil, const EigenOptions& options) {
  if ((options.count > 0) == (options.fmax_hz > 0.0) || options.count < 0 ||
      !std::isfinite(options.fmax_hz)) {
    throw InputError(fmt::format(
        "modes: found count = {} and fmax_hz = {}, expected exactly one of them to be positive",
        options.count, options.fmax_hz));
  }
  if (options.count > pencil.size()) {
    throw InputError(fmt::format("modes: found count = {}, expected at most {} (the unknowns)",
                                 options.count, pencil.size()));
  }
}

Index values_below(const VectorXd& values, double limit) {
  return (values.array() < limit).count();
}

Search::Search(const MatrixPencil& pencil, const EigenOptions& options, const Factor* factor)
    : pencil_(pencil), options_(options), n_(pencil.size()), source_(pencil, options, factor) {
  modes_.massless = pencil.bounds().massless;
}

EigenResult Search::solve(int count, int retry) {
  EigenResult found = source_.solve(count, retry);
  if (!found.ok()) throw NumericsError("modes: " + found.message);
  return found;
}

void Search::take(EigenResult&& found) {
  modes_.values = std::move(found.values);
  modes_.vectors = std::move(found.vectors);
  modes_.errors = std::move(found.errors);
}

VectorXd Search::lower_values() const {
  constexpr double kEstimates = 4.0;  // value errors are twice frequency errors; safety factor 2
  if (modes_.errors.size() == 0) return modes_.values;
  return modes_.values.array() - kEstimates * modes_.errors.array() * modes_.values.array().abs();
}

Index Search::below(const VectorXd& values, double limit) const {
  return (limit > 0.0 ? known() : 0) + values_below(values, limit);
}

bool Search::agrees() const {
  return below(modes_.values, modes_.proof.limit) == modes_.proof.below;
}

bool Search::may_agree() const {
  const double limit = modes_.proof.limit;
  return approximate() && below(modes_.values, limit) <= modes_.proof.below &&
         below(lower_values(), limit) >= modes_.proof.below;
}

void Search::prove(double limit) {
  modes_.proof.limit = limit;
  if (!options_.prove_count) return;
  const InertiaCount count = pencil_.count_below(limit, source_.order());
  modes_.proof.seconds += count.seconds;
  if (count.zero > 0) {
    const double hz = hz_of_value(limit);
    if (options_.fmax_hz > 0.0)
      throw NumericsError(
          fmt::format("modes: {:.6g} Hz is an eigenfrequency; choose another limit", hz));
    throw NumericsError(fmt::format(
        "modes: K - mu M is singular to rounding at {:.6g} Hz, between two computed modes, so that "
        "none can be counted: the model has cells that are too flat, jumps of stiffness, or points "
        "without mass that nothing holds (a hinge)",
        hz));
  }
  modes_.proof.below = count.negative;
}

void Search::match_proof(int count) {
  for (int retry = modes_.retries;; ++retry) {
    modes_.retries = retry;
    take(solve(count, retry));
    if (!options_.prove_count) return;
    const Index found = below(modes_.values, modes_.proof.limit);
    modes_.proof.proved = agrees();
    if (modes_.proof.proved || may_agree()) return;
    const std::string mismatch =
        fmt::format("inertia counts {} modes below {:.6g} Hz, the solver found {}",
                    modes_.proof.below, hz_of_value(modes_.proof.limit), found);
    if (source_.return_to_first_shift()) {
      say(mismatch + "; searching again from the first shift");
      --retry;
      continue;
    }
    if (retry >= options_.max_retries) throw NumericsError("modes: " + mismatch);
    warn(mismatch + "; searching again from a new start");
  }
}

/// The widest relative gap after the first `count` elastic values: {values before it, limit within
/// it}.
/// @param lower lower bounds of the exact values.
std::pair<Index, double> widest_gap(const VectorXd& values, const VectorXd& lower, Index count,
                                    double scale) {
  Index best = count;
  double width = -1.0, limit = 0.0;
  for (Index j = count; j < values.size(); ++j) {
    const double last = j > 0 ? values[j - 1] : 0.0;
    const double here = (lower[j] - last) / (std::abs(values[j]) + std::max(scale, 1e-300));
    if (here <= width) continue;
    best = j;
    width = here;
    limit = 0.5 * (lower[j] + last);
  }
  if (width < kSameValue) return {values.size(), 0.0};
  return {best, limit};
}

void Search::find_by_count() {
  const auto all = static_cast<int>(n_ - known() - modes_.massless);
  const auto wanted = static_cast<int>(std::max<Index>(0, options_.count - known()));
  for (int extra = kExtra;; extra *= 4) {
    const int requested = std::min(wanted + extra, all);
    take(solve(requested, modes_.retries));
    const VectorXd& values = modes_.values;
    if (values.size() <= wanted) {  // the complete spectrum: nothing can be missing
      modes_.proof = {true, values.size() > 0 ? values.tail(1)[0] : 0.0, values.size() + known(),
                      0.0};
      break;
    }
    const auto [before, limit] =
        widest_gap(values, lower_values(), wanted, 1e-6 * std::abs(source_.sigma()));
    const bool found_gap = before < values.size();
    if (!found_gap && requested < all && !approximate()) continue;  // a cluster: continue
    modes_.next_value = lower_values()[wanted];
    if (!found_gap && approximate()) break;  // the errors leave no gap: no proof possible
    prove(limit);
    if (options_.prove_count && !agrees()) {
      if (source_.return_to_first_shift()) {
        say("a mode is missing; searching again from the first shift");
        continue;
      }
      ++modes_.retries;
      if (modes_.retries > options_.max_retries) {
        throw NumericsError(
            fmt::format("modes: inertia counts {} modes below {:.6g} Hz, the solver found {}",
                        modes_.proof.below, hz_of_value(limit), before + known()));
      }
      warn("a mode is missing; searching again from a new start");
      match_proof(static_cast<int>(std::min<Index>(all, modes_.proof.below - known() + kExtra)));
    }
    modes_.proof.proved = options_.prove_count && agrees();
    break;
  }
  keep_first(std::min<Index>(wanted, modes_.size()));
}

void Search::find_by_limit_unproved(double limit) {
  constexpr int kMore = 20;  // modes more than estimated: error of the estimate for few modes
  const Index all = n_ - known() - modes_.massless;
  int count = kMore + (small() ? 0 : source_.estimated_below(limit));
  for (;; count += count / 2) {
    const int requested = static_cast<int>(std::min<Index>(count, all));
    take(solve(requested, 0));
    if (requested == all || modes_.values.size() < requested || modes_.values.tail(1)[0] >= limit)
      return;
  }
}

void Search::find_by_limit() {
  const double limit = value_of_hz(options_.fmax_hz);
  modes_.next_value = limit;
  if (!options_.prove_count || small()) {
    find_by_limit_unproved(limit);
    if (options_.prove_count) {
      prove(limit);
      modes_.proof.proved = agrees();
    }
    modes_.proof.limit = limit;
  } else {
    prove(limit);
    modes_.proof.proved = modes_.proof.below == known();
    if (modes_.proof.below > n_ / 2) {
      throw InputError(
          fmt::format("modes: {} of {} modes lie below {:.6g} Hz; expected less than "
                      "half of all",
                      modes_.proof.below, n_, options_.fmax_hz));
    }
    // Some more than wanted: the last copies of a multiple value converge with their neighbours.
    const auto elastic = static_cast<int>(modes_.proof.below - known());
    if (elastic != 0) match_proof(std::max(elastic, 0) + kExtra);
  }
  // The count gives the number; errors may have raised some above the limit.
  const bool counted = options_.prove_count && may_agree();
  const Index kept = counted ? modes_.proof.below - known() : values_below(modes_.values, limit);
  if (!counted && approximate() && kept < modes_.values.size())
    modes_.next_value = std::min(limit, lower_values()[kept]);
  keep_first(kept);
}

void Search::keep_first(Index count) {
  modes_.values.conservativeResize(count);
  if (approximate()) modes_.errors.conservativeResize(count);
  modes_.vectors.conservativeResize(pencil_.rows(), count);
}

bool Search::worth_refining() const {
  return !(modes_.residuals.maxCoeff() <= options_.max_residual);
}

void Search::finish() {
  modes_.sigma = source_.sigma();
  modes_.method = source_.method();
  modes_.factor = source_.report();
  modes_.seconds = source_.seconds();
  const std::vector<int64_t>& order = source_.order();
  if (modes_.size() > 0) {
    const auto stiffness = pencil_.stiffness(order);
    std::shared_ptr<const SymmetricOperator> own;
    if (small()) own = pencil_.mass({});
    const SymmetricOperator& inertia = own ? *own : source_.mass();
    const auto measure = [&] {
      modes_.residuals = residuals_of(*stiffness, inertia, modes_, pencil_.team());
    };
    measure();
    // With massless DoFs, one step removes rounding components of infinite modes.
    // After the return to a large shift, it gives low values their digits.
    const int least = modes_.massless > 0 || source_.returned() ? 1 : 0;
    for (int k = 0;
         k < kMaxRefinements && !small() && !approximate() && (k < least || worth_refining());
         ++k) {
      // The factor reduces high-frequency components most, and these dominate the residuals.
      refine_modes(source_.problem(), source_.mass(), modes_.vectors, modes_.values);
      modes_.solves += modes_.size();
      measure();
    }
  }
  restore_order(order, modes_, pencil_.team());
  if (!approximate()) refuse_residuals(pencil_, modes_, options_.max_residual);
  modes_.solves += source_.solves();
  modes_.factors = source_.factors();
  insert_rigid(pencil_, source_.rigid(), options_.rigid.has_value(), modes_);
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
                    const Factor* factor) {
  if (K.rows() != M.rows() || K.rows() == 0)
    throw InputError(fmt::format("modes: K has {} rows and M {}", K.rows(), M.rows()));
  return solve_modes(LocalPencil(K, M), options, factor);
}

ModeSet solve_modes(const MatrixPencil& pencil, const EigenOptions& options, const Factor* factor) {
  check_request(pencil, options);
  const int64_t n = pencil.size(), masses = n - pencil.bounds().massless;
  if (masses == 0) throw InputError("modes: found M = 0, expected some mass");
  const LocalMatrices* local = pencil.local();
  if (masses < n && masses <= options.dense_limit && n > options.dense_limit && factor == nullptr &&
      local != nullptr)
    return solve_few_masses(local->K, local->M, options);
  return Search(pencil, options, factor).run();
}

}  // namespace clatter::sparse
