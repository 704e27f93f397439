#pragma once
// How many eigenvalues lie where, roughly, from a few random vectors.
#include "modal/eigen/subtree_product.hpp"

namespace clatter::modal {

/// The nu above which about `count` eigenvalues of A lie, by stochastic Lanczos quadrature (Lin,
/// Saad and Yang, Approximating spectral densities of large matrices, 2016): right to some per
/// cent of `count`.
double density_cut(const SubtreeProduct& A, int64_t size, double count, uint64_t seed);

}  // namespace clatter::modal
