// T^T A T for a transformation that is the identity but for a few pivot rows.
#include <algorithm>
#include <vector>

#include "assembly/elimination.hpp"

namespace clatter::assembly {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

/// A split by displacements that remain (f) and pivots (p).
struct Split {
  SparseMatrix storage;        // holds the entries of A_ff, moved together
  std::vector<int32_t> outer;  // column starts of A_ff in the new numbering
  SparseMatrix A_pf;           // pivots x n
  SparseMatrix A_pp;           // pivots x pivots, both triangles

  /// A_ff, n x n, lower, without a copy.
  Eigen::Map<const SparseMatrix> kept() const {
    const auto n = static_cast<Eigen::Index>(outer.size()) - 1;
    return {n, n, outer.back(), outer.data(), storage.innerIndexPtr(), storage.valuePtr()};
  }
};

/// Sends one entry of the lower triangle to its part; entries of fixed displacements vanish.
struct Sorter {
  const Elimination& elimination;
  std::vector<int32_t> pivot_number;
  Triplets pf, pp;

  explicit Sorter(const Elimination& e) : elimination(e), pivot_number(e.reduced_of.size(), -1) {
    for (size_t p = 0; p < e.pivots.size(); ++p)
      pivot_number[static_cast<size_t>(e.pivots[p])] = static_cast<int32_t>(p);
  }

  /// True when the entry stays in the kept part.
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
    return false;
  }
};

/// The new numbers ascend with the old ones, so the kept entries are moved up in place.
Split split(SparseMatrix& lower, const Elimination& elimination) {
  Sorter sorter(elimination);
  Split parts;
  parts.storage.swap(lower);  // Eigen 3.4 copies where std::move is asked for
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
      inner[to] = elimination.reduced_of[static_cast<size_t>(inner[from])];
      values[to++] = values[from];
    }
    const int32_t reduced = elimination.reduced_of[static_cast<size_t>(col)];
    if (reduced >= 0) parts.outer[static_cast<size_t>(reduced) + 1] = to;
  }
  // The generalised coordinates follow the displacements and have no entries yet.
  for (size_t c = 1; c < parts.outer.size(); ++c)
    parts.outer[c] = std::max(parts.outer[c], parts.outer[c - 1]);
  const auto pivots = static_cast<Eigen::Index>(elimination.pivots.size());
  parts.A_pf.resize(pivots, n);
  parts.A_pf.setFromTriplets(sorter.pf.begin(), sorter.pf.end());
  parts.A_pp.resize(pivots, pivots);
  parts.A_pp.setFromTriplets(sorter.pp.begin(), sorter.pp.end());
  return parts;
}

/// Lower triangle of X + X^T, X = P^T (A_pf + 1/2 A_pp P): what the pivots bring in.
SparseMatrix change_by_pivots(const Split& parts, const SparseMatrix& P) {
  const SparseMatrix right = parts.A_pf + SparseMatrix(0.5 * (parts.A_pp * P));
  const SparseMatrix X = SparseMatrix(P.transpose()) * right;
  return SparseMatrix(X + SparseMatrix(X.transpose())).triangularView<Eigen::Lower>();
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

}  // namespace

void transform(SparseMatrix& lower, const Elimination& elimination) {
  if (elimination.size() == lower.cols() && elimination.pivots.empty()) return;
  const Split parts = split(lower, elimination);
  // u_p = P q: 1/2 u^T A u = 1/2 (kept) + q^T X q, whose second derivative is kept + X + X^T.
  SparseMatrix result = sum_of(parts.kept(), change_by_pivots(parts, elimination.pivot_rows));
  lower.swap(result);
}

}  // namespace clatter::assembly
