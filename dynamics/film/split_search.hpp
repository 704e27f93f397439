// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which cells change their state from one solve of the film to the next.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clatter::film {

/// Search of the active sets of a piecewise linear system.
///
/// Every violated state changes at once: a Newton step (Hintermueller, Ito and Kunisch 2003), which
/// finds most splits in a few solves, and moves a boundary by at least one cell in each. The next
/// split depends on the present one alone, so the steps either end or return to a split that was
/// there before. Then states change one by one, smallest index first, which cannot cycle on a
/// P-matrix (Murty 1974), until fewer are violated than ever before (Judice and Pires 1994). The
/// return is detected, not guessed from a number of solves, which grows with the grid (hard case
/// N7).
class SplitSearch {
 public:
  /// A new search from some split.
  void start();
  /// `violated`: indices of the states that violate their bound, ascending, at least one. Returns
  /// how many of them, from the front, are to change: all or one.
  size_t count(const std::vector<int>& violated);

 private:
  std::vector<uint64_t> seen_;  // splits of this search, as changes from the first one
  uint64_t split_ = 0;
  size_t fewest_ = 0;
  bool one_by_one_ = false;
};

}  // namespace clatter::film
