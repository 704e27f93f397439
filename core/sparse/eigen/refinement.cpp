// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/refinement.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/dense_product.hpp"

namespace clatter::sparse {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kBlockColumns = 32;  // vectors processed at a time
constexpr Index kTileHeight = 2048;  // rows processed at a time

}  // namespace

void refine_modes(const ShiftInvert& problem, const SymmetricOperator& mass_of, MatrixXd& X,
                  VectorXd& values) {
  const Index m = X.cols(), n = X.rows();
  MatrixXd shifted = MatrixXd::Zero(m, m), mass = shifted;  // upper triangles of the projections
  // Besides X, which may fill half the memory, only two row-major blocks are held.
  RowMatrix image(n, kBlockColumns), block(n, kBlockColumns);
  const auto project = [&](Index first, MatrixXd& onto) {  // columns of X up to this block
    const Index count = std::min(kBlockColumns, m - first), end = first + count;
    onto.block(0, first, end, count) =
        transposed_rows_product(X.leftCols(end), image).leftCols(count);
  };
  const auto take_image = [&](Index first) {
    const Index count = std::min(kBlockColumns, m - first);
    block.rightCols(kBlockColumns - count).setZero();
    block.leftCols(count) = X.middleCols(first, count);
    mass_of.multiply(block.data(), image.data(), static_cast<int>(kBlockColumns));
  };
  for (Index first = 0; first < m; first += kBlockColumns) {
    const Index count = std::min(kBlockColumns, m - first);
    take_image(first);
    problem.solve(image.data(), block.data(), static_cast<int>(kBlockColumns));
    X.middleCols(first, count) = block.leftCols(count);
    project(first, shifted);
  }
  for (Index first = 0; first < m; first += kBlockColumns) {
    take_image(first);
    project(first, mass);
  }
  problem.team->sum(shifted.data(), shifted.size());
  problem.team->sum(mass.data(), mass.size());
  const dense::Eigenpairs ritz = dense::symmetric_eigen(mass.transpose(), shifted.transpose());
  if (!ritz.ok) throw NumericsError("modes: the refined vectors are linearly dependent");
  const VectorXd nu = ritz.values.reverse();
  values = problem.sigma + nu.array().inverse();
  const MatrixXd to_modes =
      ritz.vectors.rowwise().reverse() * nu.cwiseSqrt().cwiseInverse().asDiagonal();
  parallel_pieces(n, [&](int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; row += kTileHeight) {
      auto tile = X.middleRows(row, std::min(kTileHeight, end - row));
      tile = (tile * to_modes).eval();
    }
  });
}

}  // namespace clatter::sparse
