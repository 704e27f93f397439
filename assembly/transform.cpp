// T^T A T for a transformation that is the identity but for a few pivot rows.
#include <algorithm>
#include <vector>

#include "assembly/elimination.hpp"

namespace clatter::assembly {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

/// A split by displacements that remain (f) and pivots (p).
struct Split {
  SparseMatrix kept;  // A_ff in the new numbering, lower
  SparseMatrix A_pf;  // pivots x n
  SparseMatrix A_pp;  // pivots x pivots, both triangles
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
Split split(SparseMatrix&& lower, const Elimination& elimination) {
  Sorter sorter(elimination);
  const Eigen::Index n = elimination.size();
  lower.makeCompressed();
  int32_t* outer = lower.outerIndexPtr();
  int32_t* inner = lower.innerIndexPtr();
  double* values = lower.valuePtr();
  std::vector<int32_t> new_outer(static_cast<size_t>(n) + 1, 0);
  int32_t to = 0;
  for (Eigen::Index col = 0; col < lower.cols(); ++col) {
    for (int32_t from = outer[col]; from < outer[col + 1]; ++from) {
      if (!sorter.sort(inner[from], col, values[from])) continue;
      inner[to] = elimination.reduced_of[static_cast<size_t>(inner[from])];
      values[to++] = values[from];
    }
    const int32_t reduced = elimination.reduced_of[static_cast<size_t>(col)];
    if (reduced >= 0) new_outer[static_cast<size_t>(reduced) + 1] = to;
  }
  // The generalised coordinates follow the displacements and have no entries yet.
  for (size_t c = 1; c < new_outer.size(); ++c)
    new_outer[c] = std::max(new_outer[c], new_outer[c - 1]);
  Split parts;
  parts.kept = Eigen::Map<const SparseMatrix>(n, n, to, new_outer.data(), inner, values);
  lower.resize(0, 0);
  lower.data().squeeze();
  const auto pivots = static_cast<Eigen::Index>(elimination.pivots.size());
  parts.A_pf.resize(pivots, n);
  parts.A_pf.setFromTriplets(sorter.pf.begin(), sorter.pf.end());
  parts.A_pp.resize(pivots, pivots);
  parts.A_pp.setFromTriplets(sorter.pp.begin(), sorter.pp.end());
  return parts;
}

}  // namespace

SparseMatrix transform(SparseMatrix&& lower, const Elimination& elimination) {
  const bool unchanged = elimination.size() == lower.cols() && elimination.pivots.empty();
  if (unchanged) return std::move(lower);
  Split parts = split(std::move(lower), elimination);
  if (elimination.pivots.empty()) return std::move(parts.kept);
  // u_p = P q: 1/2 u^T A u = 1/2 (kept) + q^T X q with X = P^T (A_pf + 1/2 A_pp P), whose second
  // derivative is kept + X + X^T.
  const SparseMatrix& P = elimination.pivot_rows;
  SparseMatrix X;
  {
    const SparseMatrix right = parts.A_pf + SparseMatrix(0.5 * (parts.A_pp * P));
    X = SparseMatrix(P.transpose()) * right;
  }
  const SparseMatrix X_transposed = X.transpose();
  const SparseMatrix change = SparseMatrix(X + X_transposed).triangularView<Eigen::Lower>();
  X.resize(0, 0);
  SparseMatrix sum = parts.kept + change;
  sum.makeCompressed();
  return sum;
}

}  // namespace clatter::assembly
