// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Estimated distribution of eigenvalues, from a few random vectors.
#include <vector>

#include "core/sparse/eigen/subtree_product.hpp"

namespace clatter::sparse {

/// The number of eigenvalues of A above a nu, by stochastic Lanczos quadrature (Lin, Saad and Yang,
/// Approximating spectral densities of large matrices, 2016): accurate to a few per cent for the
/// first hundred, then up to 50 % too large, since few nodes lie there.
class ModeDensity {
 public:
  static constexpr int kSolves = 160;  // products with A
  struct Point {
    double nu, count;
  };

  ModeDensity(const SubtreeProduct& A, int64_t size, uint64_t seed);
  /// The nu above which there are about `count` eigenvalues.
  double nu_above(double count) const;
  /// Estimated number of eigenvalues above nu.
  double count_above(double nu) const;

 private:
  std::vector<std::vector<Point>> vectors_;  // for each: nu descending, count ascending
};

}  // namespace clatter::sparse
