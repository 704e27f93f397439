#include "modal/eigen/refinement.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/threads.hpp"
#include "modal/dense_eigen.hpp"
#include "modal/dense_product.hpp"

namespace clatter::modal {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kColumns = 64;  // of vectors that are handled at a time
constexpr Index kRows = 2048;   // the same

}  // namespace

void refine_modes(const ShiftInvert& problem, const SymmetricProduct& mass_of, MatrixXd& X,
                  VectorXd& values) {
  const Index m = X.cols(), n = X.rows();
  MatrixXd shifted = MatrixXd::Zero(m, m), mass = shifted;  // upper triangles of the projections
  RowMatrix image(n, kColumns), answer(n, kColumns);
  for (Index first = 0; first < m; first += kColumns) {
    const Index count = std::min(kColumns, m - first), end = first + count;
    image.setZero();
    image.leftCols(count) = mass_of * X.middleCols(first, count);
    problem.solve(image.data(), answer.data(), static_cast<int>(kColumns));
    X.middleCols(first, count) = answer.leftCols(count);
    shifted.block(0, first, end, count) =
        transposed_product(X.leftCols(end), MatrixXd(image.leftCols(count)));
  }
  for (Index first = 0; first < m; first += kColumns) {
    const Index count = std::min(kColumns, m - first), end = first + count;
    mass.block(0, first, end, count) =
        transposed_product(X.leftCols(end), mass_of * X.middleCols(first, count));
  }
  const DenseEigen ritz = symmetric_eigen(mass.transpose(), shifted.transpose());
  if (!ritz.ok) throw NumericsError("modes: the refined vectors depend on each other");
  const VectorXd nu = ritz.values.reverse();
  values = problem.sigma + nu.array().inverse();
  const MatrixXd to_modes =
      ritz.vectors.rowwise().reverse() * nu.cwiseSqrt().cwiseInverse().asDiagonal();
  parallel_pieces(n, [&](int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; row += kRows) {
      auto tile = X.middleRows(row, std::min(kRows, end - row));
      tile = (tile * to_modes).eval();
    }
  });
}

}  // namespace clatter::modal
