// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/mode_values.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::sparse {

double value_of_hz(double hz) { return std::pow(2.0 * std::numbers::pi * hz, 2); }
double hz_of_value(double value) {
  return std::sqrt(std::max(value, 0.0)) / (2.0 * std::numbers::pi);
}

double default_shift(const SparseMatrix& K, const SparseMatrix& M) {
  std::vector<double> ratio;
  ratio.reserve(K.cols());
  for (int j = 0; j < K.cols(); ++j) {
    const double m = M.coeff(j, j);
    if (m > 0.0) ratio.push_back(K.coeff(j, j) / m);
  }
  if (ratio.empty()) throw InputError("modes: M has no mass on its diagonal");
  auto median = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2);
  std::nth_element(ratio.begin(), median, ratio.end());
  // A body of n DoFs is about n^(1/3) elements long.
  return -0.1 * *median * std::pow(static_cast<double>(K.cols()), -2.0 / 3.0);
}

}  // namespace clatter::sparse
