// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/mode_values.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::sparse {

double value_of_hz(double hz) { return std::pow(2.0 * std::numbers::pi * hz, 2); }
double hz_of_value(double value) {
  return std::sqrt(std::max(value, 0.0)) / (2.0 * std::numbers::pi);
}

}  // namespace clatter::sparse
