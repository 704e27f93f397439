#pragma once
// Products with a sparse symmetric matrix, many columns at once, on all threads.
#include <Eigen/Core>

#include "core/sparse.hpp"

namespace clatter::modal {

/// Holds both triangles, so that each row of the result is one sum: same bits on any thread count.
class SymmetricProduct {
 public:
  /// @param lower n x n, lower triangle.
  explicit SymmetricProduct(const SparseMatrix& lower);
  /// A x; x is n x m.
  Eigen::MatrixXd operator*(const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  /// y = A x for `count` vectors that stand row by row, n x count: the fast way.
  void multiply(const double* x, double* y, int count) const;
  Eigen::Index size() const { return full_.cols(); }

 private:
  SparseMatrix full_;
};

}  // namespace clatter::modal
