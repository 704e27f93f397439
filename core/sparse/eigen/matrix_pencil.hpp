// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// K and M of an eigenproblem, held by this process alone or by a team.
#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/sparse/eigen/arpack_solver.hpp"
#include "core/sparse/factor/factor.hpp"
#include "core/sparse/factor/inertia.hpp"
#include "core/sparse/row_team.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::sparse {

/// Properties of K and M that limit the shift.
struct PencilBounds {
  double top = 0.0;               // largest K_jj / M_jj [rad2/s2]: about the highest eigenvalue
  int64_t massless = 0;           // DoFs without mass; each gives an infinite eigenvalue
  double smallest_shift() const;  // |sigma| below which sigma M is lost in the rounding of K
};

/// Complete matrices of one process, n x n, symmetric, lower triangles.
struct LocalMatrices {
  const SparseMatrix& K;  // [N/m]
  const SparseMatrix& M;  // [kg]
};

/// K x = lambda M x, symmetric, n x n, M positive semidefinite. Tall matrices have rows() rows:
/// those of this process.
class MatrixPencil {
 public:
  virtual ~MatrixPencil() = default;
  virtual int64_t size() const = 0;       // n, of the team
  virtual Eigen::Index rows() const = 0;  // of this process
  virtual const RowTeam& team() const = 0;
  /// Diagonal entries of K and of M, rows() each.
  virtual std::pair<Eigen::VectorXd, Eigen::VectorXd> diagonals() const = 0;
  PencilBounds bounds() const;
  /// A negative shift of about a tenth of the first elastic eigenvalue of a compact body, from the
  /// median of K_jj / M_jj (the square of the highest frequency of an element) and the number of
  /// unknowns. The quality of the guess affects only the speed.
  double default_shift() const;
  /// Of K - sigma M. Throws NotPositiveDefinite, or NumericsError when it does not fit into memory.
  virtual std::unique_ptr<Factor> factor(double sigma, const FactorOptions& options) const = 0;
  /// Eigenvalues below a limit; `order` is a fill-reducing permutation, may be empty.
  virtual InertiaCount count_below(double limit, const std::vector<int64_t>& order) const = 0;
  /// Fast products in elimination order: row j is row order[j]; empty: unchanged.
  virtual std::shared_ptr<const SymmetricOperator> stiffness(
      const std::vector<int64_t>& order) const = 0;
  virtual std::shared_ptr<const SymmetricOperator> mass(
      const std::vector<int64_t>& order) const = 0;
  /// K x, M x and |K| |x| with entrywise magnitudes, for a few columns.
  virtual Eigen::MatrixXd stiffness_times(const Eigen::MatrixXd& x) const = 0;
  virtual Eigen::MatrixXd mass_times(const Eigen::MatrixXd& x) const = 0;
  virtual Eigen::MatrixXd magnitude_times(const Eigen::MatrixXd& x) const = 0;
  /// The complete matrices; null where a team shares them.
  virtual const LocalMatrices* local() const { return nullptr; }
  /// ARPACK for vectors whose rows this process, or the team, has.
  virtual std::unique_ptr<ArpackRoutines> arpack() const {
    return std::make_unique<ArpackRoutines>();
  }
};

/// The pencil of one process.
class LocalPencil : public MatrixPencil {
 public:
  /// @param K, M must outlive this.
  LocalPencil(const SparseMatrix& K, const SparseMatrix& M) : own_{K, M} {}
  int64_t size() const override { return own_.K.cols(); }
  Eigen::Index rows() const override { return own_.K.cols(); }
  const RowTeam& team() const override { return one_process(); }
  std::pair<Eigen::VectorXd, Eigen::VectorXd> diagonals() const override {
    return {own_.K.diagonal(), own_.M.diagonal()};
  }
  std::unique_ptr<Factor> factor(double sigma, const FactorOptions& options) const override;
  InertiaCount count_below(double limit, const std::vector<int64_t>& order) const override;
  std::shared_ptr<const SymmetricOperator> stiffness(
      const std::vector<int64_t>& order) const override;
  std::shared_ptr<const SymmetricOperator> mass(const std::vector<int64_t>& order) const override;
  Eigen::MatrixXd stiffness_times(const Eigen::MatrixXd& x) const override;
  Eigen::MatrixXd mass_times(const Eigen::MatrixXd& x) const override;
  Eigen::MatrixXd magnitude_times(const Eigen::MatrixXd& x) const override;
  const LocalMatrices* local() const override { return &own_; }

 private:
  LocalMatrices own_;
};

/// The default shift of matrices of this process.
inline double default_shift(const SparseMatrix& K, const SparseMatrix& M) {
  return LocalPencil(K, M).default_shift();
}

}  // namespace clatter::sparse
