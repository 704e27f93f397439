// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The symmetric shift-invert operator on subtrees of a factor.
#include <vector>

#include "core/sparse/eigen/substructures.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::sparse {

/// A = L^{-1} S P M P^T S L^{-T} with P S (K - sigma M) S P^T = L L^T: A y = y / (lambda - sigma).
/// The principal block of complete subtrees is the same operator with all other unknowns fixed.
class SubtreeProduct {
 public:
  /// @param mass P M P^T. Both must outlive this.
  SubtreeProduct(const SupernodalFactor& factor, const SymmetricProduct& mass);

  /// z = A x on a subtree, row-major from its first index; `count` is a multiple of kLanes.
  /// x receives S L^{-T} x, the displacements. @param wide all threads, else only this one.
  void apply(const Substructure& part, double* x, double* z, int count, bool wide) const;
  /// x <- S L^{-T} x on all unknowns, on all threads.
  void to_displacement(double* x, int count) const;

  int32_t first_index(int32_t supernode) const { return factor_.tree().first[supernode]; }
  Substructure full_tree() const { return {0, factor_.tree().supernodes(), 0, 0}; }

 private:
  FactorView view(const Substructure& part) const;
  void scale(int64_t first, int64_t rows, double* x, int count) const;

  const SupernodalFactor& factor_;
  const SymmetricProduct& mass_;
  std::vector<double> scale_;  // by index in elimination order
};

}  // namespace clatter::sparse
