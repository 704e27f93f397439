#pragma once
// The symmetric operator of shift-invert on the subtrees of a factor.
#include <vector>

#include "core/sparse/eigen/substructures.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::sparse {

/// A = L^{-1} S P M P^T S L^{-T} with P S (K - sigma M) S P^T = L L^T: A y = y / (lambda - sigma).
/// A principal block of whole subtrees is the same operator of their unknowns alone, the others
/// held.
class SubtreeProduct {
 public:
  /// @param mass P M P^T. Both must outlive this.
  SubtreeProduct(const SupernodalFactor& factor, const SymmetricProduct& mass);

  /// z = A x on a subtree, row by row from its first place on; `count` is a multiple of kLanes.
  /// x receives S L^{-T} x, the motion. @param wide all threads, else this one only.
  void apply(const Substructure& part, double* x, double* z, int count, bool wide) const;
  /// x <- S L^{-T} x on all unknowns, on all threads.
  void to_motion(double* x, int count) const;

  int32_t place(int32_t supernode) const {
    return factor_.tree().first[static_cast<size_t>(supernode)];
  }
  Substructure whole() const { return {0, factor_.tree().supernodes(), 0, 0}; }

 private:
  FactorView view(const Substructure& part) const;
  void scale(int64_t first, int64_t rows, double* x, int count) const;

  const SupernodalFactor& factor_;
  const SymmetricProduct& mass_;
  std::vector<double> scale_;  // by place
};

}  // namespace clatter::sparse
