// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The lowest modes of one problem by the requested solver: dense, block Lanczos, ARPACK or AMLS.
// Completeness is checked by the caller.
#include <string>
#include <vector>

#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/eigen/shifted_pencil.hpp"

namespace clatter::sparse {

class ModeSource {
 public:
  /// @param problem, options, factor as in solve_modes; must outlive this.
  ModeSource(const MatrixPencil& problem, const EigenOptions& options, const Factor* factor);

  /// Whether a dense solver is used: rows keep their order, else they are in elimination order.
  bool dense() const;
  /// The lowest `count` modes besides the rigid-body modes; each retry uses other start vectors.
  EigenResult solve(int count, int retry);
  /// Another attempt with the first shift of the search, if that has moved; false if not.
  bool return_to_first_shift();
  /// That has happened: values far below the shift need refinement.
  bool returned() const { return returned_; }
  /// Estimated number of modes below a value [rad2/s2]; for sparse problems.
  int estimated_below(double limit);

  /// n x m, M-orthonormal, original row order: known motions without stiffness.
  const Eigen::MatrixXd& rigid() const { return rigid_; }
  double sigma() const { return dense() ? dense_sigma_ : pencil_.sigma(); }
  const std::string& method() const { return method_; }
  const std::vector<int64_t>& order() const { return pencil_.order(); }
  const ShiftInvert& problem() const { return pencil_.problem(); }
  const SymmetricOperator& mass() const { return pencil_.mass(); }
  const FactorReport& report() const { return pencil_.report(); }
  /// Totals so far: solves with a factor, factorisations, seconds in the solvers.
  int64_t solves() const { return solves_ + pencil_.solves(); }
  int factors() const { return pencil_.factors(); }
  double seconds() const { return seconds_; }

 private:
  EigenResult attempt(int count, int retry);
  EigenResult by_dense(int count);
  /// Moves the shift when the first blocks show that it is too far.
  EigenResult by_block_lanczos(int count, int retry);
  EigenResult by_amls(int count, int retry);
  EigenResult by_arpack(int count, int retry);
  uint64_t seed(int retry) const { return options_.seed + 7919 * static_cast<uint64_t>(retry); }
  /// The caller's start vector in elimination order; empty when there is none.
  Eigen::VectorXd start(int retry) const;

  const MatrixPencil& given_;
  const EigenOptions& options_;
  const Eigen::Index n_;  // of the team
  const Eigen::MatrixXd rigid_;
  const Wanted wanted_;
  ShiftedPencil pencil_;
  double dense_sigma_ = 0.0;
  bool returned_ = false;
  std::string method_;
  int64_t solves_ = 0;
  double seconds_ = 0.0;
};

}  // namespace clatter::sparse
