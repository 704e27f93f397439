// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/static_factor.hpp"

#include <numeric>

#include "core/modes/factor_failure.hpp"

namespace clatter::modal {

sparse::SupernodalFactor static_factor(const SparseMatrix& K) {
  sparse::FactorOptions options;
  options.min_rcond = 0.0;
  options.max_condition = 1e15;
  return sparse::SupernodalFactor(K, options);
}

sparse::SupernodalFactor explained_factor(const fe::FeModel& model, const SparseMatrix& K) {
  try {
    return static_factor(K);
  } catch (const sparse::NotPositiveDefinite& error) {
    std::vector<int32_t> all(static_cast<size_t>(model.size()));
    std::iota(all.begin(), all.end(), 0);
    throw modes::explained(model, "K", all, error);
  }
}

}  // namespace clatter::modal
