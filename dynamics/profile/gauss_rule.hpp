// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gauss-Legendre rules.
#include <array>

namespace clatter::dynamics {

/// Rule of `size` nodes on [-1, 1], exact for polynomials of degree 2 size - 1.
struct GaussRule {
  static constexpr int kLargest = 8;
  /// @param nodes 1 to kLargest.
  explicit GaussRule(int nodes);

  int size;
  std::array<double, kLargest> node{}, weight{};
};

}  // namespace clatter::dynamics
