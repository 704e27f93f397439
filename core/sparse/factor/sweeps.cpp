// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/sweeps.hpp"

#include <cblas.h>

#include <algorithm>
#include <vector>

#include "core/sparse/factor/sweep_kernel.hpp"

namespace clatter::sparse {
namespace {

constexpr int kPanelColumns = 48;  // of a panel at a time: their part of x stays in the L1 cache
constexpr int kTile = 96;          // rows: a tile of the panel stays in L1 for all right-hand sides

/// One supernode's part of L and of x.
struct Block {
  int columns, below;
  int64_t height;
  const double* panel;
  const int32_t* rows;  // below the own columns
  double* x;

  Block(const FactorView& L, int32_t s, const SweepColumns& all)
      : columns(L.tree->columns(s)),
        below(L.tree->rows_before(s, L.reach_index())),
        height(L.tree->height(s)),
        panel(L.panels + L.tree->panel_start[s]),
        rows(L.tree->rows_of(s) + columns),
        x(all.at + int64_t{L.tree->first[s] - L.first_index()} * all.stride) {}
};

template <class Body>
void for_each_tile(int rows, int count, Body&& body) {
  for (int first = 0; first < rows; first += kTile)
    for (int lane = 0; lane < count; lane += kLanes)
      body(first, std::min(kTile, rows - first), lane);
}

void forward_block(const Block& b, const SweepColumns& x, double* work) {
  for (int begin = 0; begin < b.columns; begin += kPanelColumns) {
    const int width = std::min(kPanelColumns, b.columns - begin), end = begin + width;
    const double* L = b.panel + begin * b.height;
    double* own = b.x + begin * x.stride;
    for (int lane = 0; lane < x.count; lane += kLanes)
      solve_lower(L + begin, b.height, width, {own + lane, x.stride});
    for_each_tile(b.columns - end, x.count, [&](int row, int rows, int lane) {
      subtract_product(L + end + row, b.height, rows, width, {own + lane, x.stride},
                       {b.x + (end + row) * x.stride + lane, x.stride});
    });
    for_each_tile(b.below, x.count, [&](int row, int rows, int lane) {
      subtract_product(L + b.columns + row, b.height, rows, width, {own + lane, x.stride},
                       {work + int64_t{row} * x.count + lane, x.count});
    });
  }
}

void backward_block(const Block& b, const SweepColumns& x, double* work) {
  for (int begin = (b.columns - 1) / kPanelColumns * kPanelColumns; begin >= 0;
       begin -= kPanelColumns) {
    const int width = std::min(kPanelColumns, b.columns - begin), end = begin + width;
    const double* L = b.panel + begin * b.height;
    double* own = b.x + begin * x.stride;
    for_each_tile(b.below, x.count, [&](int row, int rows, int lane) {
      subtract_transposed(L + b.columns + row, b.height, rows, width,
                          {work + int64_t{row} * x.count + lane, x.count}, {own + lane, x.stride});
    });
    for_each_tile(b.columns - end, x.count, [&](int row, int rows, int lane) {
      subtract_transposed(L + end + row, b.height, rows, width,
                          {b.x + (end + row) * x.stride + lane, x.stride}, {own + lane, x.stride});
    });
    for (int lane = 0; lane < x.count; lane += kLanes)
      solve_lower_transposed(L + begin, b.height, width, {own + lane, x.stride});
  }
}

/// One right-hand side: memory-bound, BLAS-2 is sufficient.
void forward_vector(const Block& b, double* work) {
  const int height = static_cast<int>(b.height);
  cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, b.columns, b.panel, height,
              b.x, 1);
  if (b.below > 0)
    cblas_dgemv(CblasColMajor, CblasNoTrans, b.below, b.columns, -1.0, b.panel + b.columns, height,
                b.x, 1, 0.0, work, 1);
}

void backward_vector(const Block& b, const double* work) {
  const int height = static_cast<int>(b.height);
  if (b.below > 0)
    cblas_dgemv(CblasColMajor, CblasTrans, b.below, b.columns, -1.0, b.panel + b.columns, height,
                work, 1, 1.0, b.x, 1);
  cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, b.columns, b.panel, height, b.x,
              1);
}

}  // namespace

void forward_step(const FactorView& L, int32_t s, const SweepColumns& x, std::vector<double>& work,
                  const RowsAfterView& after) {
  const Block b(L, s, x);
  work.assign(static_cast<size_t>(b.below) * static_cast<size_t>(x.count), 0.0);
  x.count == 1 ? forward_vector(b, work.data()) : forward_block(b, x, work.data());
  const int32_t origin = L.first_index();
  const int own = after.sums == nullptr ? b.below : L.tree->rows_before(s, L.end_index());
  const double* from = work.data();
  for (int k = 0; k < b.below; ++k, from += x.count) {
    double* to = k < own ? x.at + (b.rows[k] - origin) * x.stride
                         : after.sums + int64_t{after.index[b.rows[k]]} * x.count;
    for (int c = 0; c < x.count; ++c) to[c] += from[c];
  }
}

void backward_step(const FactorView& L, int32_t s, const SweepColumns& x,
                   std::vector<double>& work) {
  const Block b(L, s, x);
  const int32_t origin = L.first_index();
  work.resize(std::max(work.size(), static_cast<size_t>(b.below) * static_cast<size_t>(x.count)));
  double* to = work.data();
  for (int k = 0; k < b.below; ++k, to += x.count)
    std::copy_n(x.at + (b.rows[k] - origin) * x.stride, x.count, to);
  x.count == 1 ? backward_vector(b, work.data()) : backward_block(b, x, work.data());
}

void forward_sweep(const FactorView& L, const SweepColumns& x) {
  std::vector<double> work;
  for (int32_t s = L.from; s < L.end(); ++s) forward_step(L, s, x, work);
}

void backward_sweep(const FactorView& L, const SweepColumns& x) {
  std::vector<double> work;
  for (int32_t s = L.end() - 1; s >= L.from; --s) backward_step(L, s, x, work);
}

}  // namespace clatter::sparse
