// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Places of some indices of a long range.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clatter::ranks {

/// Distinct indices out of 0 .. size-1, and the place of each in their ascending list: one array of
/// `size` instead of a sort and a search for every use.
class IndexPlaces {
 public:
  explicit IndexPlaces(int64_t size) : place_(static_cast<size_t>(size), -1) {}
  void add(int64_t index) { place_[index] = 0; }
  /// Numbers the indices added, and returns them ascending.
  std::vector<int64_t> number() {
    std::vector<int64_t> listed;
    for (size_t i = 0; i < place_.size(); ++i) {
      if (place_[i] < 0) continue;
      place_[i] = static_cast<int32_t>(listed.size());
      listed.push_back(static_cast<int64_t>(i));
    }
    return listed;
  }
  /// Place of an index that was added, after number().
  int32_t operator[](int64_t index) const { return place_[index]; }

 private:
  std::vector<int32_t> place_;
};

}  // namespace clatter::ranks
