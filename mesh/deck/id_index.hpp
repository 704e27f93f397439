// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Ranges of numbers of a deck, and the rows of a table that have them.
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace clatter::mesh::deck {

/// Numbers first, first + step, ... up to last.
struct IdRange {
  int32_t first = 0, last = 0, step = 1;
  bool is_range = false;  // members that do not exist are no error
};

/// A direct table if the numbers are dense, else a sorted list: at most 16 bytes per number and a
/// quarter of a megabyte.
class IdIndex {
 public:
  IdIndex() = default;
  /// Numbers from 1; row i is that of ids[i]. Of duplicate numbers the first row counts.
  explicit IdIndex(const std::vector<int32_t>& ids);

  /// Row of a number, -1 when there is none.
  int32_t find(int32_t id) const;
  /// Calls body(row) for the existing numbers among first, first + step, ... up to last, ascending.
  template <class Body>
  void for_each(int32_t first, int32_t last, int32_t step, const Body& body) const;
  /// How many entries for_each visits.
  int64_t effort(int32_t first, int32_t last) const;
  /// Rows (first, further) of duplicate numbers.
  const std::vector<std::pair<int32_t, int32_t>>& duplicates() const { return duplicates_; }

 private:
  std::vector<int32_t> table_;                       // by number; or
  std::vector<std::pair<int32_t, int32_t>> sorted_;  // (number, row)
  std::vector<std::pair<int32_t, int32_t>> duplicates_;
};

template <class Body>
void IdIndex::for_each(int32_t first, int32_t last, int32_t step, const Body& body) const {
  if (!table_.empty()) {
    const int64_t end = std::min<int64_t>(last, static_cast<int64_t>(table_.size()) - 1);
    for (int64_t id = first; id <= end; id += step) {
      if (const int32_t row = table_[id]; row >= 0) body(row);
    }
    return;
  }
  auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<int32_t, int32_t>(first, 0));
  for (; at != sorted_.end() && at->first <= last; ++at) {
    if ((at->first - first) % step == 0) body(at->second);
  }
}

}  // namespace clatter::mesh::deck
