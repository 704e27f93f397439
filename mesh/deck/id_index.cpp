// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/id_index.hpp"

namespace clatter::mesh::deck {

IdIndex::IdIndex(const std::vector<int32_t>& ids) {
  if (ids.empty()) return;
  const auto highest = static_cast<size_t>(*std::max_element(ids.begin(), ids.end()));
  const auto rows = static_cast<int32_t>(ids.size());
  if (highest <= 4 * ids.size() + 65536) {
    table_.assign(highest + 1, -1);
    for (int32_t row = 0; row < rows; ++row) {
      int32_t& entry = table_[ids[row]];
      if (entry < 0) {
        entry = row;
      } else {
        duplicates_.emplace_back(entry, row);
      }
    }
    return;
  }
  sorted_.reserve(ids.size());
  for (int32_t row = 0; row < rows; ++row) {
    sorted_.emplace_back(ids[row], row);
  }
  std::sort(sorted_.begin(), sorted_.end());
  size_t kept = 0;
  for (size_t i = 1; i < sorted_.size(); ++i) {
    if (sorted_[i].first == sorted_[kept].first) {
      duplicates_.emplace_back(sorted_[kept].second, sorted_[i].second);
    } else {
      sorted_[++kept] = sorted_[i];
    }
  }
  sorted_.resize(kept + 1);
}

int32_t IdIndex::find(int32_t id) const {
  if (id < 1) return -1;
  if (!table_.empty()) {
    return static_cast<size_t>(id) < table_.size() ? table_[id] : -1;
  }
  const auto at =
      std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<int32_t, int32_t>(id, 0));
  return at != sorted_.end() && at->first == id ? at->second : -1;
}

int64_t IdIndex::effort(int32_t first, int32_t last) const {
  const auto all = static_cast<int64_t>(table_.empty() ? sorted_.size() : table_.size());
  return std::min(int64_t{last} - first + 1, all);
}

}  // namespace clatter::mesh::deck
