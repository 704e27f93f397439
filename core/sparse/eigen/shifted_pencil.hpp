#pragma once
// K - sigma M, factorised: the operator that all sparse eigen-solvers work with, and the choice of
// its shift.
#include <memory>
#include <vector>

#include "core/sparse/eigen/known_motions.hpp"
#include "core/sparse/eigen/shift_invert.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::sparse {

/// What K and M allow, whatever the shift is.
struct PencilBounds {
  double top = 0.0;               // largest K_jj / M_jj [rad2/s2]: the highest eigenvalue, about
  int64_t massless = 0;           // unknowns without any mass: as many infinite eigenvalues
  double smallest_shift() const;  // |sigma| below which rounding of K drowns sigma M
};

PencilBounds bounds_of(const SparseMatrix& K, const SparseMatrix& M);

/// The modes that are asked for: all below a limit, or the lowest so many.
struct Wanted {
  int count = 0;
  double limit = 0.0;  // [rad2/s2]
  /// About the highest of them: values of a solid grow with the power 2/3 of their number (Weyl).
  double highest(double lowest) const;
};

class ShiftedPencil {
 public:
  /// @param K, M n x n, symmetric, lower triangle; must outlive this.
  /// @param rigid n x m, M-orthonormal, K rigid = 0; may have no columns.
  ShiftedPencil(const SparseMatrix& K, const SparseMatrix& M, const FactorOptions& options,
                const Eigen::MatrixXd& rigid);
  ShiftedPencil(const ShiftedPencil&) = delete;
  ShiftedPencil& operator=(const ShiftedPencil&) = delete;

  /// The factor of K - sigma M that the caller has.
  void use(const SupernodalFactor& given, double sigma);
  /// Factorises K - sigma M, in the order of the first time. Throws NotPositiveDefinite.
  void shift_to(double sigma);
  /// The first shift, from the matrices alone: 0 where nothing is free to move, else default_shift.
  /// @param known the rigid motions are all there are; else Ritz values far below the shift may be
  /// zeros that have not converged, and are passed over.
  void start_shift(bool known);
  /// Moves the shift where Ritz values show that it is far above the lowest elastic eigenvalue, to
  /// a little below that one. A shift that is too far costs Lanczos about the square root of its
  /// distance; each new factor brings it a factor of 1e4 or more closer.
  /// @param ritz eigenvalues from above, ascending [rad2/s2].
  /// @param wanted how far the search goes: a new factor pays only where that lies below the shift.
  /// @returns true where the shift has moved; false: it is settled.
  bool follow(const Eigen::VectorXd& ritz, const Wanted& wanted);
  /// Looks at the Ritz values of a few blocks until the shift need not move.
  void find_shift(const Wanted& wanted, uint64_t seed);

  /// Without the rigid motions, in the order of the factor.
  const ShiftInvert& problem() const { return problem_; }
  /// The whole operator, rigid motions included.
  const ShiftInvert& whole() const { return whole_; }
  const SymmetricProduct& mass() const { return *mass_; }
  const KnownMotions& rigid() const { return *rigid_; }
  const std::vector<int64_t>& order() const { return order_; }
  double sigma() const { return problem_.sigma; }
  /// The factor; made anew when it was given back.
  const SupernodalFactor& factor();
  void give_back() { own_.reset(); }
  const FactorReport& report() const { return report_; }
  /// Vectors that went through a factor to find the shift, and factors made.
  int64_t solves() const { return solves_; }
  int factors() const { return factors_; }

 private:
  void set_order(const std::vector<int64_t>& order);
  bool try_shift(double sigma);
  /// -size, or the smallest multiple of it by powers of 30 at which K - sigma M has a factor.
  void shift_from(double size);

  const SparseMatrix& K_;
  const SparseMatrix& M_;
  FactorOptions options_;
  const Eigen::MatrixXd& given_rigid_;
  const SupernodalFactor* given_ = nullptr;
  std::unique_ptr<SupernodalFactor> own_;
  std::vector<int64_t> order_;
  std::unique_ptr<SymmetricProduct> mass_;
  std::unique_ptr<KnownMotions> rigid_;
  ShiftInvert problem_, whole_;
  FactorReport report_;
  int64_t solves_ = 0;
  int factors_ = 0;
  int moves_left_ = 0;          // of the shift; none where it is settled
  double least_ = 0.0;          // smallest shift
  bool rigid_complete_ = true;  // the rigid motions are all there are
};

}  // namespace clatter::sparse
