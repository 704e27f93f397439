// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/subtree_product.hpp"

#include "core/base/threads.hpp"
#include "core/sparse/factor/sweep_kernel.hpp"

namespace clatter::sparse {
namespace {

/// body(columns, rest): lanes of x for each thread.
template <class Body>
void split_lanes(int count, bool wide, Body&& body) {
  const auto piece = [&](int64_t begin, int64_t end) {
    body(begin * kLanes, static_cast<int>((end - begin) * kLanes));
  };
  if (wide) return parallel_pieces(count / kLanes, piece);
  piece(0, count / kLanes);
}

}  // namespace

SubtreeProduct::SubtreeProduct(const SupernodalFactor& factor, const SymmetricProduct& mass)
    : factor_(factor), mass_(mass) {
  for (const int32_t unknown : factor.tree().order) scale_.push_back(factor.scale()[unknown]);
}

FactorView SubtreeProduct::view(const Substructure& part) const {
  FactorView view = factor_.view();
  view.from = part.lowest;
  view.to = part.to;
  return view;
}

void SubtreeProduct::scale(int64_t first, int64_t rows, double* x, int count) const {
  for (int64_t j = 0; j < rows; ++j) {
    const double s = scale_[first + j];
    for (int c = 0; c < count; ++c) x[j * count + c] *= s;
  }
}

void SubtreeProduct::apply(const Substructure& part, double* x, double* z, int count,
                           bool wide) const {
  const FactorView L = view(part);
  const int64_t first = L.first_index(), end = L.end_index(), rows = end - first;
  split_lanes(count, wide, [&](int64_t lane, int lanes) {
    backward_sweep(L, {x + lane, lanes, count});
  });
  scale(first, rows, x, count);
  mass_.multiply_block(first, end, x, z, count, wide);
  scale(first, rows, z, count);
  split_lanes(count, wide, [&](int64_t lane, int lanes) {
    forward_sweep(L, {z + lane, lanes, count});
  });
}

void SubtreeProduct::to_displacement(double* x, int count) const {
  split_lanes(count, true, [&](int64_t lane, int lanes) {
    backward_sweep(factor_.view(), {x + lane, lanes, count});
  });
  scale(0, mass_.size(), x, count);
}

}  // namespace clatter::sparse
