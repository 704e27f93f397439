// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/krylov_basis.hpp"

#include <cblas.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <vector>

#include "core/base/blas_kernel.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/dense_product.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kRowTile = 512;  // rows whose products stay in the cache

/// body(first row, rows) for tiles of [begin, end).
template <class Body>
void for_each_row_tile(Index begin, Index end, Body&& body) {
  for (Index row = begin; row < end; row += kRowTile) body(row, std::min(kRowTile, end - row));
}

/// Distributes rows to the threads, one BLAS thread each.
template <class Body>
void on_all_threads(Index size, Body&& body) {
  const BlasThreads one(1);
  parallel_pieces(size, [&](int64_t begin, int64_t end) { for_each_row_tile(begin, end, body); });
}

/// Sum over all rows of the products `add(row, rows, sum)`, one partial sum per thread.
template <class Add>
MatrixXd summed(Index size, Index rows, Index columns, Add&& add) {
  const BlasThreads one(1);
  const Index pieces = std::min<Index>(thread_count(), size);
  std::vector<MatrixXd> parts(static_cast<size_t>(pieces), MatrixXd::Zero(rows, columns));
  parallel_pieces(pieces, [&](int64_t piece, int64_t) {
    MatrixXd& sum = parts[piece];
    for_each_row_tile(size * piece / pieces, size * (piece + 1) / pieces,
                      [&](Index row, Index count) { add(row, count, sum); });
  });
  for (size_t p = 1; p < parts.size(); ++p) parts[0] += parts[p];
  return std::move(parts[0]);
}

}  // namespace

TallBlock::TallBlock(Index rows, Index columns)
    : data(large_array(static_cast<size_t>(rows * columns))), size(rows), count(columns) {}

bool TallBlock::finite() const {
  std::atomic<bool> all = true;
  parallel_pieces(size * count, [&](int64_t begin, int64_t end) {
    if (!std::all_of(data.get() + begin, data.get() + end,
                     [](double value) { return std::isfinite(value); }))
      all = false;
  });
  return all;
}

MatrixXd gram(const TallBlock& A, const TallBlock& B) {
  return summed(A.size, A.count, B.count, [&](Index row, Index rows, MatrixXd& sum) {
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, blas_size(A.count), blas_size(B.count),
                blas_size(rows), 1.0, A.row(row), blas_size(A.count), B.row(row),
                blas_size(B.count), 1.0, sum.data(), blas_size(A.count));
  });
}

void transform(TallBlock& A, const MatrixXd& R) {
  const int b = blas_size(A.count);
  on_all_threads(A.size, [&](Index row, Index rows) {
    const Eigen::MatrixXd old = Eigen::Map<const MatrixXd>(A.row(row), A.count, rows);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, b, blas_size(rows), b, 1.0, R.data(), b,
                old.data(), b, 0.0, A.row(row), b);
  });
}

KrylovBasis::KrylovBasis(Index size, Index room, Storage storage)
    : size_(size),
      room_(room),
      data_(storage == Storage::kDisk ? spilled_array(static_cast<size_t>(size * room))
                                      : large_array(static_cast<size_t>(size * room))) {}

/// body(row, rows, column, columns) for the tiles of columns [first, last) in rows [begin, end);
/// while one is used, the next is prefetched.
template <class Body>
void KrylovBasis::over_tiles(Index begin, Index end, Index first, Index last, Body&& body) const {
  constexpr Index kTileRows = 48, kTileColumns = 96, kLine = 8;
  const auto fetch = [&](Index row, Index column) {
    if (column >= last) {
      row += kTileRows;
      column = first;
    }
    const Index stop = std::min(row + kTileRows, end);
    const Index columns = std::min(kTileColumns, last - column);
    for (Index i = row; i < stop; ++i)
      for (Index c = 0; c < columns; c += kLine) __builtin_prefetch(at(i, column) + c);
  };
  for (Index row = begin; row < end; row += kTileRows) {
    for (Index column = first; column < last; column += kTileColumns) {
      fetch(row, column + kTileColumns);
      body(row, blas_size(std::min(kTileRows, end - row)), column,
           blas_size(std::min(kTileColumns, last - column)));
    }
  }
}

MatrixXd KrylovBasis::coefficients(Index first, Index last, const TallBlock& B) const {
  const Index pieces = std::min<Index>(thread_count(), size_);
  std::vector<RowMatrix> parts(static_cast<size_t>(pieces), RowMatrix::Zero(last - first, B.count));
  parallel_pieces(pieces, [&](int64_t piece, int64_t) {
    RowMatrix& H = parts[piece];
    over_tiles(size_ * piece / pieces, size_ * (piece + 1) / pieces, first, last,
               [&](Index row, int rows, Index column, int columns) {
                 for (Index lane = 0; lane < B.count; lane += kLanes)
                   subtract_product(at(row, column), room_, columns, rows,
                                    {const_cast<double*>(B.row(row)) + lane, B.count},
                                    {H.row(column - first).data() + lane, B.count});
               });
  });
  for (size_t p = 1; p < parts.size(); ++p) parts[0] += parts[p];
  return -parts[0];
}

void KrylovBasis::subtract(Index first, const MatrixXd& H, TallBlock& B) const {
  RowMatrix weights = H;
  parallel_pieces(size_, [&](int64_t begin, int64_t end) {
    over_tiles(begin, end, first, first + H.rows(),
               [&](Index row, int rows, Index column, int columns) {
                 for (Index lane = 0; lane < B.count; lane += kLanes)
                   subtract_transposed(at(row, column), room_, columns, rows,
                                       {weights.row(column - first).data() + lane, B.count},
                                       {B.row(row) + lane, B.count});
               });
  });
}

void KrylovBasis::put(Index first, const TallBlock& B) {
  on_all_threads(size_, [&](Index row, Index rows) {
    for (Index i = row; i < row + rows; ++i) std::copy_n(B.row(i), B.count, at(i, first));
  });
}

void KrylovBasis::get(Index first, TallBlock& B) const {
  on_all_threads(size_, [&](Index row, Index rows) {
    for (Index i = row; i < row + rows; ++i) std::copy_n(at(i, first), B.count, B.row(i));
  });
}

void KrylovBasis::transform(const MatrixXd& S) {
  const int from = blas_size(S.rows()), to = blas_size(S.cols());
  on_all_threads(size_, [&](Index row, Index rows) {
    MatrixXd tile(S.cols(), rows);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, to, blas_size(rows), from, 1.0, S.data(),
                from, at(row, 0), blas_size(room_), 0.0, tile.data(), to);
    for (Index i = 0; i < rows; ++i) std::copy_n(tile.col(i).data(), to, at(row + i, 0));
  });
}

MatrixXd KrylovBasis::take_columns(Index count) {
  MatrixXd out(size_, count);
  prefer_large_pages(out.data(), static_cast<size_t>(out.size()) * sizeof(double));
  on_all_threads(size_, [&](Index row, Index rows) {
    out.middleRows(row, rows) = Eigen::Map<const RowMatrix, 0, Eigen::OuterStride<>>(
        at(row, 0), rows, count, Eigen::OuterStride<>(room_));
    give_back_pages(at(row, 0), static_cast<size_t>(rows * room_) * sizeof(double));
  });
  return out;
}

}  // namespace clatter::sparse
