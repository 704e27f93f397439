// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/inertia.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "core/base/log.hpp"
#include "core/base/stopwatch.hpp"
#include "core/sparse/factor/multifrontal.hpp"
#include "core/sparse/factor/mumps_inertia.hpp"

namespace clatter::sparse {
namespace {

/// The diagonal of K sets the scale: that of K - mu M may vanish.
std::vector<double> scale_of(const SparseMatrix& K) {
  std::vector<double> scale(static_cast<size_t>(K.cols()), 1.0);
  for (int j = 0; j < K.cols(); ++j) {
    const double d = K.coeff(j, j);
    if (d > 0.0 && std::isfinite(d)) scale[j] = std::exp2(-std::round(0.5 * std::log2(d)));
  }
  return scale;
}

}  // namespace

InertiaCount count_below(const SparseMatrix& K, const SparseMatrix& M, double mu,
                         const std::vector<int64_t>& permutation) {
  constexpr double kGrowth = 1e3;
  const Stopwatch clock;
  const SparseMatrix shifted = K - mu * M;
  const SupernodeTree tree = analyse_tree(shifted, {Ordering::kMetis, permutation});
  InertiaCount count;
  std::mutex mutex;
  const FrontKernel kernel = [&](int32_t, const Front& front) {
    const PivotSigns signs = eliminate_symmetric(front);
    const std::lock_guard<std::mutex> lock(mutex);
    count.negative += signs.negative;
    count.zero += signs.zero;
    count.growth = std::max(count.growth, signs.growth);
  };
  eliminate(tree, permuted(tree, shifted, scale_of(K)), kernel, nullptr, nullptr);
  if (!(count.growth <= kGrowth)) {
    say(fmt::format("inertia count: pivots grow by {:.1e}, so MUMPS counts again", count.growth));
    count = count_below_by_mumps(K, M, mu, permutation);
  }
  count.seconds = clock.seconds();
  return count;
}

}  // namespace clatter::sparse
