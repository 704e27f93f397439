// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/schur_mass.hpp"

#include <cblas.h>

#include <algorithm>

#include "core/base/large_pages.hpp"
#include "core/sparse/factor/multifrontal.hpp"

namespace clatter::condense {
namespace {

/// @param L the panel of K's front: L11 above L21.
void carry_mass(const sparse::Front& front, const double* L) {
  const int p = front.columns, q = front.below, h = front.height();
  if (q == 0) return;
  const auto W = large_array(static_cast<size_t>(p) * static_cast<size_t>(q));
  for (int64_t j = 0; j < p; ++j) std::copy_n(L + j * h + p, q, W.get() + j * q);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, q, p, 1.0, L, h,
              W.get(), q);
  double* N = front.panel + p;
  cblas_dsymm(CblasColMajor, CblasRight, CblasLower, q, p, -0.5, front.panel, h, W.get(), q, 1.0, N,
              h);
  cblas_dsyr2k(CblasColMajor, CblasLower, CblasNoTrans, q, p, -1.0, W.get(), q, N, h, 1.0,
               front.update, q);
}

}  // namespace

Eigen::MatrixXd schur_mass(const sparse::SupernodalFactor& factor_ii, const SparseMatrix& M_ii,
                           const SparseMatrix& M_ib) {
  const sparse::SupernodeTree& tree = factor_ii.tree();
  const sparse::FrontKernel kernel = [&](int32_t s, const sparse::Front& front) {
    carry_mass(front, factor_ii.view().panels + tree.panel_start[s]);
  };
  Eigen::MatrixXd out(tree.boundary, tree.boundary);
  eliminate(tree, sparse::permuted(tree, M_ii, factor_ii.scale(), M_ib), kernel, nullptr, &out);
  return out;
}

double schur_mass_flops(const sparse::SupernodeTree& tree) {
  double flops = 0.0;
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    const double p = tree.columns(s), q = tree.below(s);
    flops += 3.0 * p * p * q + 2.0 * p * q * q;
  }
  return flops;
}

}  // namespace clatter::condense
