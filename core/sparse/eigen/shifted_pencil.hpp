// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// K - sigma M, factorised: the operator of all sparse eigen-solvers, and the choice of its shift.
#include <memory>
#include <vector>

#include "core/sparse/eigen/known_motions.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"
#include "core/sparse/eigen/shift_invert.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::sparse {

/// The requested modes: all below a limit, or the `count` lowest.
struct Wanted {
  int count = 0;
  double limit = 0.0;  // [rad2/s2]
  /// Estimate of the highest one: values of a solid grow with the power 2/3 of their number (Weyl).
  double highest(double lowest) const;
};

class ShiftedPencil {
 public:
  /// @param pencil K and M; must outlive this.
  /// @param rigid n x m, M-orthonormal, K rigid = 0; may have no columns.
  ShiftedPencil(const MatrixPencil& pencil, const FactorOptions& options,
                const Eigen::MatrixXd& rigid);
  ShiftedPencil(const ShiftedPencil&) = delete;
  ShiftedPencil& operator=(const ShiftedPencil&) = delete;

  /// Uses a factor of K - sigma M from the caller.
  void use(const Factor& given, double sigma);
  /// Factorises K - sigma M, with the permutation of the first factorisation. Throws
  /// NotPositiveDefinite.
  void shift_to(double sigma);
  /// The first shift, from the matrices only: 0 where nothing is free to move, else default_shift.
  /// @param known all rigid-body motions are known; else Ritz values far below the shift may be
  /// unconverged zeros, and are ignored.
  void start_shift(bool known);
  /// If Ritz values show that the shift is much larger than the lowest elastic eigenvalue, moves it
  /// to slightly below that. The Lanczos effort grows with about the square root of the distance;
  /// each new factor brings the shift closer by a factor of 1e4 or more.
  /// @param ritz upper bounds of eigenvalues, ascending [rad2/s2].
  /// @param wanted range of the search: a new factor pays off only where it lies below the shift.
  /// @returns true if the shift has moved; false: it is final.
  bool follow(const Eigen::VectorXd& ritz, const Wanted& wanted);
  /// Repeats follow() with the Ritz values of a few blocks until the shift is final.
  void find_shift(const Wanted& wanted, uint64_t seed);

  /// Returns to the first shift, for good, if follow() has left it: with modes so far below the
  /// others that beside them rounding hides these, as of a stiff part on soft springs, only the
  /// larger shift shows all (hard case F12). False if nothing has moved.
  bool return_to_first();

  /// Without the rigid-body motions, in elimination order.
  const ShiftInvert& problem() const { return problem_; }
  /// The complete operator, including rigid-body motions.
  const ShiftInvert& full_problem() const { return full_problem_; }
  const SymmetricOperator& mass() const { return *mass_; }
  /// The same where one process has all rows.
  const SymmetricProduct& local_mass() const;
  const KnownMotions& rigid() const { return *rigid_; }
  const std::vector<int64_t>& order() const { return order_; }
  double sigma() const { return problem_.sigma; }
  /// The factor; recomputed after release_factor().
  const Factor& factor();
  /// The same where one process has all rows.
  const SupernodalFactor& local_factor();
  void release_factor() { own_.reset(); }
  const FactorReport& report() const { return report_; }
  /// Solves with a factor to find the shift, and number of factorisations.
  int64_t solves() const { return solves_; }
  int factors() const { return factors_; }

 private:
  void set_order(const std::vector<int64_t>& order);
  bool try_shift(double sigma);
  /// -size, or the smallest multiple of it by powers of 30 at which K - sigma M has a factor.
  void shift_from(double size);

  const MatrixPencil& pencil_;
  FactorOptions options_;
  const Eigen::MatrixXd& given_rigid_;
  const Factor* given_ = nullptr;
  std::unique_ptr<Factor> own_;
  std::vector<int64_t> order_;
  std::shared_ptr<const SymmetricOperator> mass_;
  std::unique_ptr<KnownMotions> rigid_;
  ShiftInvert problem_, full_problem_;
  FactorReport report_;
  int64_t solves_ = 0;
  int factors_ = 0;
  int moves_left_ = 0;          // of the shift; 0 when it is final
  double least_ = 0.0;          // smallest shift
  double first_ = 0.0;          // chosen from the matrices only
  bool rigid_complete_ = true;  // all rigid-body motions are known
};

}  // namespace clatter::sparse
