// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parallel products of a sparse symmetric matrix with many columns.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter::sparse {

/// P A P^T of a symmetric matrix given by its lower triangle: row j is row order[j] of A.
SparseMatrix reordered(const SparseMatrix& lower, const std::vector<int64_t>& order);

/// y = A x with a symmetric matrix A, n x n; x and y have the rows of this process.
class SymmetricOperator {
 public:
  virtual ~SymmetricOperator() = default;
  /// A x; x is n x m.
  virtual Eigen::MatrixXd operator*(const Eigen::Ref<const Eigen::MatrixXd>& x) const = 0;
  /// y = A x for `count` row-major vectors, n x count: the faster form.
  virtual void multiply(const double* x, double* y, int count) const = 0;
  /// Rows of this process.
  virtual Eigen::Index size() const = 0;

 protected:
  SymmetricOperator() = default;
  SymmetricOperator(const SymmetricOperator&) = default;
  SymmetricOperator& operator=(const SymmetricOperator&) = default;
};

/// Holds both triangles, so that each row of the result is one sum: same bits for any thread count.
class SymmetricProduct : public SymmetricOperator {
 public:
  /// @param lower n x n, lower triangle.
  explicit SymmetricProduct(const SparseMatrix& lower);
  Eigen::MatrixXd operator*(const Eigen::Ref<const Eigen::MatrixXd>& x) const override;
  void multiply(const double* x, double* y, int count) const override;
  /// The same with only the principal block of rows [first, last); x and y begin at row `first`,
  /// `count` is a multiple of 8. @param wide all threads, else only this one.
  void multiply_block(int64_t first, int64_t last, const double* x, double* y, int count,
                      bool wide) const;
  Eigen::Index size() const override { return full_.cols(); }

 private:
  SparseMatrix full_;
};

}  // namespace clatter::sparse
