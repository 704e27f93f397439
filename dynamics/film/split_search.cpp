// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/split_search.hpp"

#include <algorithm>
#include <limits>

namespace clatter::film {
namespace {

// A random number for each state (the finaliser of the generator splitmix64). A split is the
// exclusive or of those that differ from the first split: two of them agree by chance once in 2^64.
uint64_t key_of(int state) {
  uint64_t key = (static_cast<uint64_t>(state) + 1) * 0x9e3779b97f4a7c15u;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  return key ^ (key >> 31);
}

}  // namespace

void SplitSearch::start() {
  split_ = 0;
  seen_.assign(1, split_);
  fewest_ = std::numeric_limits<size_t>::max();
  one_by_one_ = false;
}

size_t SplitSearch::count(const std::vector<int>& violated) {
  if (violated.size() < fewest_) one_by_one_ = false;
  fewest_ = std::min(fewest_, violated.size());
  if (!one_by_one_) {
    uint64_t next = split_;
    for (int state : violated) next ^= key_of(state);
    if (std::find(seen_.begin(), seen_.end(), next) == seen_.end()) {
      split_ = next;
      seen_.push_back(next);
      return violated.size();
    }
    one_by_one_ = true;
  }
  split_ ^= key_of(violated.front());
  return 1;
}

}  // namespace clatter::film
