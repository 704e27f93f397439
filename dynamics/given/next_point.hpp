// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points of a table that repeats.
#include <algorithm>
#include <cmath>
#include <span>

namespace clatter::dynamics {

/// The first point above `at` of ascending points within less than one period, repeated with it.
inline double next_periodic_point(std::span<const double> x, double period, double at) {
  // A turn further where rounding puts `at` at the end of its turn.
  for (double turn = std::floor((at - x.front()) / period);; ++turn) {
    const double begin = turn * period;
    auto next = std::upper_bound(x.begin(), x.end(), at - begin);
    for (; next != x.end(); ++next)
      if (begin + *next > at) return begin + *next;
  }
}

}  // namespace clatter::dynamics
