// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/symmetric_product.hpp"

#include <algorithm>

#include "core/base/each_cpu.hpp"
#include "core/base/threads.hpp"

namespace clatter::sparse {
namespace {

constexpr int kRegisterColumns = 8;  // columns in registers per read of the matrix

/// Rows [begin, end) of `width` <= kRegisterColumns columns; column i of A serves as row i. Rows of
/// x and y lie `stride` apart.
template <int Width>
inline __attribute__((always_inline)) void multiply_rows(const SparseMatrix& A, const double* x,
                                                         double* y, int64_t stride, int64_t begin,
                                                         int64_t end) {
  const int32_t* starts = A.outerIndexPtr();
  const int32_t* rows = A.innerIndexPtr();
  const double* values = A.valuePtr();
  for (int64_t i = begin; i < end; ++i) {
    double sum[Width] = {};
    for (int32_t k = starts[i]; k < starts[i + 1]; ++k) {
      const double a = values[k];
      const double* row = x + rows[k] * stride;
      for (int c = 0; c < Width; ++c) sum[c] += a * row[c];
    }
    for (int c = 0; c < Width; ++c) y[i * stride + c] = sum[c];
  }
}

CLATTER_EACH_CPU void multiply_eight(const SparseMatrix& A, const double* x, double* y,
                                     int64_t stride, int64_t begin, int64_t end) {
  multiply_rows<kRegisterColumns>(A, x, y, stride, begin, end);
}

CLATTER_EACH_CPU void multiply_one(const SparseMatrix& A, const double* x, double* y,
                                   int64_t stride, int64_t begin, int64_t end) {
  multiply_rows<1>(A, x, y, stride, begin, end);
}

CLATTER_EACH_CPU void multiply_eight_within(const SparseMatrix& A, const double* x, double* y,
                                            int64_t stride, int64_t first, int64_t last,
                                            int64_t begin, int64_t end) {
  const int32_t* starts = A.outerIndexPtr();
  for (int64_t i = begin; i < end; ++i) {
    double sum[kRegisterColumns] = {};
    for (int32_t k = starts[i]; k < starts[i + 1]; ++k) {
      const int64_t column = A.innerIndexPtr()[k];
      if (column < first || column >= last) continue;
      const double a = A.valuePtr()[k];
      const double* row = x + (column - first) * stride;
      for (int c = 0; c < kRegisterColumns; ++c) sum[c] += a * row[c];
    }
    std::copy_n(sum, kRegisterColumns, y + (i - first) * stride);
  }
}

}  // namespace

SparseMatrix reordered(const SparseMatrix& lower, const std::vector<int64_t>& order) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse(lower.cols());
  for (size_t j = 0; j < order.size(); ++j)
    inverse.indices()[static_cast<Eigen::Index>(order[j])] = static_cast<int>(j);
  SparseMatrix out(lower.rows(), lower.cols());
  out.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(inverse);
  return out;
}

SymmetricProduct::SymmetricProduct(const SparseMatrix& lower)
    : full_(lower.selfadjointView<Eigen::Lower>()) {
  full_.prune(1.0, 0.0);  // a consistent mass matrix couples equal directions only
  full_.makeCompressed();
}

void SymmetricProduct::multiply(const double* x, double* y, int count) const {
  constexpr int64_t kRows = 4096;  // neighbouring rows of x stay in the cache for all columns
  parallel_pieces(full_.cols(), [&](int64_t begin, int64_t end) {
    for (int64_t first = begin; first < end; first += kRows) {
      const int64_t last = std::min(first + kRows, end);
      int c = 0;
      for (; c + kRegisterColumns <= count; c += kRegisterColumns)
        multiply_eight(full_, x + c, y + c, count, first, last);
      for (; c < count; ++c) multiply_one(full_, x + c, y + c, count, first, last);
    }
  });
}

void SymmetricProduct::multiply_block(int64_t first, int64_t last, const double* x, double* y,
                                      int count, bool wide) const {
  const auto rows = [&](int64_t begin, int64_t end) {
    for (int c = 0; c + kRegisterColumns <= count; c += kRegisterColumns)
      multiply_eight_within(full_, x + c, y + c, count, first, last, first + begin, first + end);
  };
  wide ? parallel_pieces(last - first, rows) : rows(0, last - first);
}

Eigen::MatrixXd SymmetricProduct::operator*(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  const Eigen::Index n = full_.cols();
  Eigen::MatrixXd y(n, x.cols());
  RowMatrix from, to;
  for (Eigen::Index first = 0; first < x.cols(); first += kRegisterColumns) {
    const Eigen::Index count = std::min<Eigen::Index>(kRegisterColumns, x.cols() - first);
    from = x.middleCols(first, count);
    to.resize(n, count);
    multiply(from.data(), to.data(), static_cast<int>(count));
    y.middleCols(first, count) = to;
  }
  return y;
}

}  // namespace clatter::sparse
