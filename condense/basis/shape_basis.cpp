// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/shape_basis.hpp"

#include <algorithm>

#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/dense_product.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// x -= Q Q^T M x; Q^T M Q = I.
void remove(const MatrixXd& Q, const sparse::SymmetricOperator& M, const sparse::RowTeam& team,
            MatrixXd& x) {
  if (Q.cols() == 0) return;
  sparse::add_product(-1.0, Q, team.sum(sparse::transposed_product(Q, M * x)), x);
}

/// Collects M-orthonormal columns.
class Collector {
 public:
  Collector(const MatrixXd& kept, const sparse::SymmetricOperator& M, const sparse::RowTeam& team,
            Index most)
      : kept_(kept), M_(M), team_(team), columns_(kept.rows(), most) {}

  /// Adds the columns of `block`, of which the first has index `first`.
  void take(MatrixXd block, Index first, std::vector<int>& dependent) {
    scale(block);
    const MatrixXd found = columns_.leftCols(count_);
    for (int pass = 0; pass < 2; ++pass) {
      remove(kept_, M_, team_, block);
      remove(found, M_, team_, block);
    }
    const Index before = count_;
    for (Index j = 0; j < block.cols(); ++j) {
      MatrixXd column = block.col(j);
      const MatrixXd inside = columns_.middleCols(before, count_ - before);
      for (int pass = 0; pass < 2; ++pass) remove(inside, M_, team_, column);
      const double left = norm(column);
      if (!(left > kDependent)) {
        dependent.push_back(static_cast<int>(first + j));
        continue;
      }
      column /= left;
      // Removes rounding that was amplified by scaling a small remainder to unit length.
      remove(kept_, M_, team_, column);
      remove(columns_.leftCols(count_), M_, team_, column);
      columns_.col(count_++) = column / norm(column);
    }
  }
  MatrixXd columns() const { return columns_.leftCols(count_); }

 private:
  static constexpr double kDependent = 1e-9;

  double norm(const MatrixXd& column) const {
    return std::sqrt(std::max(0.0, team_.sum(column.col(0).dot((M_ * column).col(0)))));
  }
  /// Scales to unit norm; zero stays zero.
  void scale(MatrixXd& block) const {
    const Eigen::VectorXd lengths = team_.norms(block);
    for (Index j = 0; j < block.cols(); ++j) {
      block.col(j) /= std::max(lengths[j], 1e-300);
      const double length = norm(block.col(j));
      if (length > 0.0) block.col(j) /= length;
    }
  }

  const MatrixXd& kept_;
  const sparse::SymmetricOperator& M_;
  const sparse::RowTeam& team_;
  MatrixXd columns_;
  Index count_ = 0;
};

}  // namespace

ShapeBasis shape_basis(const MatrixXd& shapes, const MatrixXd& kept,
                       const sparse::MatrixPencil& pencil) {
  constexpr Index kBlock = 32;
  const auto mass = pencil.mass({}), stiffness = pencil.stiffness({});
  const sparse::RowTeam& team = pencil.team();
  ShapeBasis out;
  Collector collector(kept, *mass, team, shapes.cols());
  for (Index first = 0; first < shapes.cols(); first += kBlock) {
    const Index count = std::min(kBlock, shapes.cols() - first);
    collector.take(shapes.middleCols(first, count), first, out.dependent);
  }
  const MatrixXd columns = collector.columns();
  const MatrixXd K_cc = team.sum(sparse::transposed_product(columns, *stiffness * columns));
  const dense::Eigenpairs eig = dense::symmetric_eigen(0.5 * (K_cc + K_cc.transpose()));
  out.vectors = MatrixXd::Zero(columns.rows(), columns.cols());
  sparse::add_product(1.0, columns, eig.vectors, out.vectors);
  out.values = eig.values;
  return out;
}

}  // namespace clatter::condense
