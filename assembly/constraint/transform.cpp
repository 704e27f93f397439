// SPDX-License-Identifier: GPL-3.0-or-later
// T^T A T for a transformation that is the identity except for a few pivot rows.
//
// With u = [u_f; u_p; u_s], f the displacements that remain, p the pivots, s the supported ones,
// and u_p = P q + P_s s, the form 1/2 u^T A u has the blocks
//   qq:  A_ff + X + X^T,  X = P^T (A_pf + 1/2 A_pp P)
//   sq:  A_sf + A_sp P + P_s^T (A_pf + A_pp P)
//   ss:  A_ss + Y + Y^T,  Y = P_s^T (A_ps + 1/2 A_pp P_s).
#include <algorithm>
#include <utility>
#include <vector>

#include "assembly/constraint/elimination.hpp"

namespace clatter::assembly {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

/// A split by displacements that remain (f), pivots (p) and supported ones (s).
struct Split {
  SparseMatrix storage;        // holds the entries of A_ff, moved together
  std::vector<int32_t> outer;  // column starts of A_ff after renumbering
  SparseMatrix A_pf;           // pivots x n
  SparseMatrix A_pp;           // pivots x pivots, both triangles
  SparseMatrix A_sf, A_sp;     // supports x n, supports x pivots; empty unless requested
  SparseMatrix A_ss;           // supports x supports, lower triangle

  /// A_ff, n x n, lower, without a copy.
  Eigen::Map<const SparseMatrix> kept() const {
    const auto n = static_cast<Eigen::Index>(outer.size()) - 1;
    return {n, n, outer.back(), outer.data(), storage.innerIndexPtr(), storage.valuePtr()};
  }
};

SparseMatrix from_triplets(Eigen::Index rows, Eigen::Index cols, const Triplets& entries) {
  SparseMatrix matrix(rows, cols);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Assigns one entry of the lower triangle to its block.
struct Sorter {
  const Elimination& elimination;
  bool with_supports;
  std::vector<int32_t> pivot_number;
  Triplets pf, pp, sf, sp, ss;

  Sorter(const Elimination& e, bool supports)
      : elimination(e), with_supports(supports), pivot_number(e.reduced_of.size(), -1) {
    for (size_t p = 0; p < e.pivots.size(); ++p)
      pivot_number[e.pivots[p]] = static_cast<int32_t>(p);
  }

  /// True when the entry stays in A_ff.
  bool sort(Eigen::Index row, Eigen::Index col, double value) {
    const auto i = static_cast<size_t>(row), j = static_cast<size_t>(col);
    const int32_t ri = elimination.reduced_of[i], rj = elimination.reduced_of[j];
    if (ri >= 0 && rj >= 0) return true;
    const int32_t pi = pivot_number[i], pj = pivot_number[j];
    if (pi >= 0 && rj >= 0) pf.emplace_back(pi, rj, value);
    if (pj >= 0 && ri >= 0) pf.emplace_back(pj, ri, value);
    if (pi >= 0 && pj >= 0) {
      pp.emplace_back(pi, pj, value);
      if (i != j) pp.emplace_back(pj, pi, value);
    }
    if (!with_supports) return false;
    const int32_t si = elimination.support_of[i], sj = elimination.support_of[j];
    if (si >= 0 && rj >= 0) sf.emplace_back(si, rj, value);
    if (sj >= 0 && ri >= 0) sf.emplace_back(sj, ri, value);
    if (si >= 0 && pj >= 0) sp.emplace_back(si, pj, value);
    if (sj >= 0 && pi >= 0) sp.emplace_back(sj, pi, value);
    if (si >= 0 && sj >= 0) ss.emplace_back(std::max(si, sj), std::min(si, sj), value);
    return false;
  }
};

/// Renumbering preserves the order, so the kept entries are compacted in place.
Split split(SparseMatrix&& lower, const Elimination& elimination, bool with_supports) {
  Sorter sorter(elimination, with_supports);
  Split parts;
  parts.storage.swap(lower);  // Eigen 3.4 copies on std::move
  parts.storage.makeCompressed();
  const int32_t* outer = parts.storage.outerIndexPtr();
  int32_t* inner = parts.storage.innerIndexPtr();
  double* values = parts.storage.valuePtr();
  const Eigen::Index n = elimination.size();
  parts.outer.assign(static_cast<size_t>(n) + 1, 0);
  int32_t to = 0;
  for (Eigen::Index col = 0; col < parts.storage.cols(); ++col) {
    for (int32_t from = outer[col]; from < outer[col + 1]; ++from) {
      if (!sorter.sort(inner[from], col, values[from])) continue;
      inner[to] = elimination.reduced_of[inner[from]];
      values[to++] = values[from];
    }
    const int32_t reduced = elimination.reduced_of[col];
    if (reduced >= 0) parts.outer[static_cast<size_t>(reduced) + 1] = to;
  }
  // The generalised coordinates follow the displacements and have no entries yet.
  for (size_t c = 1; c < parts.outer.size(); ++c)
    parts.outer[c] = std::max(parts.outer[c], parts.outer[c - 1]);
  const auto pivots = static_cast<Eigen::Index>(elimination.pivots.size());
  const Eigen::Index supports = elimination.supports();
  parts.A_pf = from_triplets(pivots, n, sorter.pf);
  parts.A_pp = from_triplets(pivots, pivots, sorter.pp);
  if (!with_supports) return parts;
  parts.A_sf = from_triplets(supports, n, sorter.sf);
  parts.A_sp = from_triplets(supports, pivots, sorter.sp);
  parts.A_ss = from_triplets(supports, supports, sorter.ss);
  return parts;
}

SparseMatrix lower_of_sum(const SparseMatrix& X) {
  return SparseMatrix(X + SparseMatrix(X.transpose())).triangularView<Eigen::Lower>();
}

/// Lower triangle of X + X^T, the contribution of the pivots.
SparseMatrix change_by_pivots(const Split& parts, const SparseMatrix& P) {
  const SparseMatrix right = parts.A_pf + SparseMatrix(0.5 * (parts.A_pp * P));
  return lower_of_sum(SparseMatrix(P.transpose()) * right);
}

/// T_s^T A T.
SparseMatrix support_rows(const Split& parts, const Elimination& elimination) {
  const SparseMatrix& P = elimination.pivot_rows;
  const SparseMatrix P_st = elimination.pivot_rows_s.transpose();
  SparseMatrix sq = parts.A_sf + SparseMatrix(parts.A_sp * P);
  sq += SparseMatrix(P_st * SparseMatrix(parts.A_pf + SparseMatrix(parts.A_pp * P)));
  return sq;
}

/// T_s^T A T_s, lower triangle.
SparseMatrix support_block(const Split& parts, const Elimination& elimination) {
  const SparseMatrix& P_s = elimination.pivot_rows_s;
  const SparseMatrix P_st = P_s.transpose();
  const SparseMatrix right =
      SparseMatrix(parts.A_sp.transpose()) + SparseMatrix(0.5 * (parts.A_pp * P_s));
  return parts.A_ss + lower_of_sum(P_st * right);
}

/// Calls visit(row, value) for the union of two sorted columns, equal rows added.
template <typename A, typename B, typename Visit>
void merge_column(const A& a, const B& b, Eigen::Index column, const Visit& visit) {
  typename A::InnerIterator left(a, column);
  typename B::InnerIterator right(b, column);
  while (left || right) {
    const bool take_left = left && (!right || left.row() <= right.row());
    const bool take_right = right && (!left || right.row() <= left.row());
    const auto row = take_left ? left.row() : right.row();
    visit(row, (take_left ? left.value() : 0.0) + (take_right ? right.value() : 0.0));
    if (take_left) ++left;
    if (take_right) ++right;
  }
}

/// a + b with exactly the memory of the result; Eigen's own sum grows by doubling.
template <typename A, typename B>
SparseMatrix sum_of(const A& a, const B& b) {
  SparseMatrix sum(a.rows(), a.cols());
  int32_t count = 0;
  for (Eigen::Index c = 0; c < a.cols(); ++c) {
    merge_column(a, b, c, [&](Eigen::Index, double) { ++count; });
    sum.outerIndexPtr()[c + 1] = count;
  }
  sum.resizeNonZeros(count);
  int32_t at = 0;
  for (Eigen::Index c = 0; c < a.cols(); ++c)
    merge_column(a, b, c, [&](Eigen::Index row, double value) {
      sum.innerIndexPtr()[at] = static_cast<int32_t>(row);
      sum.valuePtr()[at++] = value;
    });
  return sum;
}

/// T^T A T.
SparseMatrix remaining_block(const Split& parts, const Elimination& elimination) {
  return sum_of(parts.kept(), change_by_pivots(parts, elimination.pivot_rows));
}

}  // namespace

SparseMatrix transform(SparseMatrix&& lower, const Elimination& elimination) {
  const bool same = elimination.size() == lower.cols() && elimination.pivots.empty();
  if (!same) return remaining_block(split(std::move(lower), elimination, false), elimination);
  SparseMatrix unchanged;
  unchanged.swap(lower);
  return unchanged;
}

CoordinateBlocks transform_with_supports(SparseMatrix&& lower, const Elimination& elimination) {
  const Split parts = split(std::move(lower), elimination, true);
  return {.qq = remaining_block(parts, elimination),
          .sq = support_rows(parts, elimination),
          .ss = support_block(parts, elimination)};
}

}  // namespace clatter::assembly
