#include <algorithm>

#include "mesh/deck/abaqus_model.hpp"

namespace clatter::mesh::deck::abaqus {

IdIndex::IdIndex(const std::vector<int32_t>& ids,
                 const std::function<void(int32_t, int32_t)>& twice) {
  int32_t highest = 0;
  for (const int32_t id : ids) highest = std::max(highest, id);
  if (static_cast<size_t>(highest) <= 4 * ids.size() + 1024) {
    table_.assign(static_cast<size_t>(highest) + 1, -1);
    for (size_t i = 0; i < ids.size(); ++i) {
      int32_t& place = table_[static_cast<size_t>(ids[i])];
      if (place >= 0) {
        twice(place, static_cast<int32_t>(i));
      } else {
        place = static_cast<int32_t>(i);
      }
    }
    return;
  }
  sorted_.reserve(ids.size());
  for (size_t i = 0; i < ids.size(); ++i) sorted_.emplace_back(ids[i], static_cast<int32_t>(i));
  std::sort(sorted_.begin(), sorted_.end());
  for (size_t i = 1; i < sorted_.size(); ++i) {
    if (sorted_[i].first == sorted_[i - 1].first) twice(sorted_[i - 1].second, sorted_[i].second);
  }
}

int32_t IdIndex::find(int32_t id) const {
  if (!table_.empty()) {
    return id >= 0 && static_cast<size_t>(id) < table_.size() ? table_[static_cast<size_t>(id)]
                                                              : -1;
  }
  const auto at =
      std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<int32_t, int32_t>(id, 0));
  return at != sorted_.end() && at->first == id ? at->second : -1;
}

std::vector<int32_t> IdIndex::find(const Range& range) const {
  std::vector<int32_t> places;
  if (table_.empty()) {
    auto at = std::lower_bound(sorted_.begin(), sorted_.end(),
                               std::pair<int32_t, int32_t>(range.first, 0));
    for (int32_t before = 0; at != sorted_.end() && at->first <= range.last; ++at) {
      const bool again = at->first == before;
      before = at->first;
      if (!again && (at->first - range.first) % range.step == 0) places.push_back(at->second);
    }
    return places;
  }
  const int64_t last = std::min<int64_t>(range.last, static_cast<int64_t>(table_.size()) - 1);
  for (int64_t id = range.first; id <= last; id += range.step) {
    if (table_[static_cast<size_t>(id)] >= 0) places.push_back(table_[static_cast<size_t>(id)]);
  }
  return places;
}

}  // namespace clatter::mesh::deck::abaqus
