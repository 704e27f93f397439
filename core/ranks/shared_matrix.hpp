// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A symmetric matrix by rows, each on its owner.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/ranks/row_shares.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::ranks {

struct Entry {
  int32_t row = 0, column = 0;  // indices in elimination order
  double value = 0.0;
};

/// The complete rows of this rank, both triangles, sorted by row and column.
using Entries = std::vector<Entry>;

/// y = A x; x values of other ranks' rows come by messages, once for all columns.
class SharedMatrix : public sparse::SymmetricOperator {
 public:
  /// @param with_boundary rows and columns of the boundary belong to A; else they are omitted.
  SharedMatrix(const Ranks& ranks, const RowShares& shares, const Entries& entries,
               bool with_boundary);
  Eigen::MatrixXd operator*(const Eigen::Ref<const Eigen::MatrixXd>& x) const override;
  void multiply(const double* x, double* y, int count) const override;
  Eigen::Index size() const override { return rows_; }
  /// |A| |x| with entrywise magnitudes, x n x m.
  Eigen::MatrixXd magnitude_times(const Eigen::MatrixXd& x) const;
  /// Diagonal entries of the own rows.
  const Eigen::VectorXd& diagonal() const { return diagonal_; }

 private:
  template <class Of>
  void multiply_with(Of&& of, const double* x, double* y, int count) const;

  Eigen::Index rows_ = 0;
  std::vector<int64_t> starts_;   // rows + 1
  std::vector<int32_t> columns_;  // own row, or rows_ + place among the fetched ones
  std::vector<double> values_;
  Eigen::VectorXd diagonal_;
  int64_t fetched_ = 0;
  std::unique_ptr<RowExchange> others_;
};

}  // namespace clatter::ranks
