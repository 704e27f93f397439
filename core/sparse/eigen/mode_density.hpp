#pragma once
// How many eigenvalues lie where, roughly, from a few random vectors.
#include <vector>

#include "core/sparse/eigen/subtree_product.hpp"

namespace clatter::sparse {

/// The number of eigenvalues of A above a nu, by stochastic Lanczos quadrature (Lin, Saad and Yang,
/// Approximating spectral densities of large matrices, 2016): right to some per cent for the first
/// hundred, then up to a half too large, since few nodes lie there.
class ModeDensity {
 public:
  static constexpr int kSolves = 160;  // vectors that go through A
  struct Point {
    double nu, count;
  };

  ModeDensity(const SubtreeProduct& A, int64_t size, uint64_t seed);
  /// The nu above which about `count` eigenvalues lie.
  double nu_above(double count) const;
  /// About how many eigenvalues lie above nu.
  double count_above(double nu) const;

 private:
  std::vector<std::vector<Point>> vectors_;  // of each: nu descending, count ascending
};

}  // namespace clatter::sparse
