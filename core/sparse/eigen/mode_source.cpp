// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/mode_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/sparse/eigen/amls.hpp"
#include "core/sparse/eigen/arpack_solver.hpp"
#include "core/sparse/eigen/block_lanczos.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/mode_density.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kAlmostAll = 4;      // that many fewer are left to the gap after the wanted modes
constexpr Index kAllDense = 2000;  // largest model whose complete spectrum is computed

MatrixXd rigid_modes(const MatrixPencil& problem, const EigenOptions& options) {
  if (!options.rigid) return MatrixXd(problem.rows(), 0);
  return orthonormal_in_mass(problem, *options.rigid);
}

}  // namespace

ModeSource::ModeSource(const MatrixPencil& problem, const EigenOptions& options,
                       const Factor* factor)
    : given_(problem),
      options_(options),
      n_(problem.size()),
      rigid_(rigid_modes(problem, options)),
      wanted_{options.count - static_cast<int>(rigid_.cols()),
              options.fmax_hz > 0.0 ? value_of_hz(options.fmax_hz) : 0.0},
      pencil_(problem, options.factor, rigid_) {
  if (dense()) return;
  if (factor != nullptr)
    pencil_.use(*factor, options.sigma.value_or(0.0));
  else if (options.sigma)
    pencil_.shift_to(*options.sigma);
  else
    pencil_.start_shift(options.rigid.has_value());
}

bool ModeSource::dense() const {
  if (given_.local() == nullptr) return false;
  // All modes: Krylov methods find one less than there are unknowns.
  const bool nearly_all = options_.count + kAlmostAll >= n_ && n_ <= kAllDense;
  return n_ <= options_.dense_limit || nearly_all;
}

bool ModeSource::return_to_first_shift() {
  if (dense() || !pencil_.return_to_first()) return false;
  return returned_ = true;
}

EigenResult ModeSource::solve(int count, int retry) {
  const Stopwatch clock;
  EigenResult found = attempt(count, retry);
  solves_ += found.solves;
  seconds_ += clock.seconds();
  // The vectors of AMLS need no more solves; their memory is needed for the count.
  if (found.errors.size() > 0) pencil_.release_factor();
  return found;
}

EigenResult ModeSource::attempt(int count, int retry) {
  if (dense()) return by_dense(count);
  const bool room = 2 * count + 6 * 24 < n_;
  if (room && options_.method == EigenMethod::kBlockLanczos) return by_block_lanczos(count, retry);
  if (given_.local() == nullptr && options_.method == EigenMethod::kAmls)
    throw InputError(
        "eigen_solver: found \"amls\", which one process computes, expected \"block-lanczos\" or "
        "\"arpack\" with several");
  pencil_.find_shift(wanted_, options_.seed);
  if (room && options_.method == EigenMethod::kAmls) return by_amls(count, retry);
  return by_arpack(count, retry);
}

EigenResult ModeSource::by_dense(int count) {
  const auto& [K_full, M_full] = *given_.local();
  const MatrixXd K = dense_symmetric(K_full), M = dense_symmetric(M_full);
  dense_sigma_ = options_.sigma.value_or(dense_shift(K, M));
  method_ = "dense";
  return solve_dense(K, M, rigid_, options_.sigma, count);
}

EigenResult ModeSource::by_block_lanczos(int count, int retry) {
  BlockLanczosOptions options;
  options.count = count;
  options.seed = seed(retry);
  options.start = start(retry);
  options.go_on = [this](const VectorXd& ritz) { return !pencil_.follow(ritz, wanted_); };
  method_ = name_of(EigenMethod::kBlockLanczos);
  int64_t solves = 0;
  for (;;) {
    EigenResult found = solve_block_lanczos(pencil_.problem(), options);
    found.solves = solves += found.solves;
    if (found.status != EigenStatus::kStopped) return found;
  }
}

EigenResult ModeSource::by_amls(int count, int retry) {
  AmlsOptions options;
  options.count = count;
  options.accuracy = options_.accuracy;
  options.cutoff = options_.amls_cutoff * std::pow(1.5, retry);
  options.seed = seed(retry);
  EigenResult found = solve_amls(pencil_, options);
  // Where all modes are requested, ARPACK is used.
  method_ = name_of(found.errors.size() > 0 ? EigenMethod::kAmls : EigenMethod::kArpack);
  return found;
}

EigenResult ModeSource::by_arpack(int count, int retry) {
  if (count >= n_)
    throw InputError(fmt::format(
        "modes: found a request of {} modes of {} unknowns, expected fewer, or at most {} unknowns",
        count, n_, kAllDense));
  ArpackOptions options;
  options.count = count;
  options.seed = seed(retry);
  options.basis = static_cast<int>(std::min<Index>(n_, static_cast<Index>(2 + retry) * count + 10));
  options.start = start(retry);
  method_ = name_of(EigenMethod::kArpack);
  return solve_arpack(pencil_.problem(), options, *given_.arpack());
}

VectorXd ModeSource::start(int retry) const {
  if (retry > 0 || options_.start.size() != n_) return {};
  return options_.start(pencil_.order());
}

int ModeSource::estimated_below(double limit) {
  if (given_.local() == nullptr)
    return static_cast<int>(given_.count_below(limit, order()).negative - rigid_.cols());
  pencil_.find_shift(wanted_, options_.seed);
  const ModeDensity density(SubtreeProduct(pencil_.local_factor(), pencil_.local_mass()), n_,
                            options_.seed);
  solves_ += ModeDensity::kSolves;
  return static_cast<int>(density.count_above(1.0 / (limit - sigma())));
}

}  // namespace clatter::sparse
