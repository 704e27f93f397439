// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/gauss_rule.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace clatter::dynamics {

GaussRule::GaussRule(int nodes) : size(nodes) {
  assert(nodes >= 1 && nodes <= kLargest);
  for (int i = 0; i < nodes; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (nodes + 0.5)), slope = 1.0;
    // Newton's method from this start has converged to rounding after five steps.
    for (int k = 0; k < 8; ++k) {
      double before = 1.0, value = x;
      for (int degree = 2; degree <= nodes; ++degree) {
        const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
        before = value;
        value = next;
      }
      slope = nodes * (x * value - before) / (x * x - 1.0);
      x -= value / slope;
    }
    if (2 * i + 1 == nodes) x = 0.0;
    node[i] = x;
    weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
}

}  // namespace clatter::dynamics
