#include "modal/symmetric_product.hpp"

#include <algorithm>
#include <array>

#include "core/threads.hpp"

namespace clatter::modal {
namespace {

constexpr Eigen::Index kColumns = 8;  // right-hand sides that share one read of the matrix

/// Rows [begin, end) of `count` <= kColumns columns; column i of A serves as row i.
void multiply_rows(const SparseMatrix& A, const double* x, double* y, Eigen::Index n,
                   Eigen::Index count, int64_t begin, int64_t end) {
  for (int64_t i = begin; i < end; ++i) {
    std::array<double, kColumns> sum{};
    for (int k = A.outerIndexPtr()[i]; k < A.outerIndexPtr()[i + 1]; ++k) {
      const double a = A.valuePtr()[k];
      const double* row = x + A.innerIndexPtr()[k];
      for (Eigen::Index c = 0; c < count; ++c) sum[static_cast<size_t>(c)] += a * row[c * n];
    }
    for (Eigen::Index c = 0; c < count; ++c) y[i + c * n] = sum[static_cast<size_t>(c)];
  }
}

}  // namespace

SymmetricProduct::SymmetricProduct(const SparseMatrix& lower)
    : full_(lower.selfadjointView<Eigen::Lower>()) {
  full_.prune(1.0, 0.0);  // a consistent mass matrix couples equal directions only
  full_.makeCompressed();
}

Eigen::MatrixXd SymmetricProduct::operator*(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  const Eigen::Index n = full_.cols();
  Eigen::MatrixXd y(n, x.cols());
  parallel_pieces(n, [&](int64_t begin, int64_t end) {
    for (Eigen::Index first = 0; first < x.cols(); first += kColumns) {
      const Eigen::Index count = std::min(kColumns, x.cols() - first);
      const double* column = x.data() + first * x.outerStride();
      if (x.outerStride() == n || count == 1) {
        multiply_rows(full_, column, y.col(first).data(), n, count, begin, end);
      } else {
        for (Eigen::Index c = 0; c < count; ++c) {
          multiply_rows(full_, column + c * x.outerStride(), y.col(first + c).data(), n, 1, begin,
                        end);
        }
      }
    }
  });
  return y;
}

}  // namespace clatter::modal
