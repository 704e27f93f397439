// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/set_numbers.hpp"

#include <fmt/format.h>

#include <map>

#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr size_t kMostNumbers = size_t{1} << 24;  // of one set

// Collects the numbers of a set and of those in it, each set once.
class SetNumbers {
 public:
  SetNumbers(const Scope& scope, const IdSets& sets, const Source& source)
      : scope_(scope), sets_(sets), source_(source) {}

  const std::vector<int32_t>& of(const std::string& name, Origin origin) {
    const auto [at, is_new] = done_.try_emplace(folded(name));
    Entry& entry = at->second;
    if (entry.done) return entry.numbers;
    const auto found = sets_.find(folded(name));
    if (found == sets_.end()) source_.fail(origin, fmt::format("found no set {}", shown(name)));
    if (!is_new || ++depth_ > kDeepest) {
      source_.fail(origin, fmt::format("set {} holds itself", shown(name)));
    }
    std::vector<int32_t> out;
    for (const SetChunk& chunk : found->second.chunks) add_chunk(chunk, out);
    --depth_;
    sort_unique(out);
    entry.numbers = std::move(out);
    entry.done = true;
    return entry.numbers;
  }

 private:
  static constexpr int kDeepest = 64;
  struct Entry {
    std::vector<int32_t> numbers;
    bool done = false;
  };

  void add(const std::vector<int32_t>& more, Origin origin, std::vector<int32_t>& out) const {
    if (out.size() + more.size() > kMostNumbers) source_.fail(origin, "found too large a set");
    out.insert(out.end(), more.begin(), more.end());
  }

  void add_chunk(const SetChunk& chunk, std::vector<int32_t>& out) {
    add(chunk.ids, chunk.origin, out);
    for (int32_t row = chunk.row_begin; row < chunk.row_end; ++row) {
      out.push_back(rows_of(chunk)[row]);
    }
    for (const IdRange& range : chunk.ranges) {
      for (int64_t id = range.first; id <= range.last; id += range.step) {
        if (out.size() >= kMostNumbers) source_.fail(chunk.origin, "found too large a set");
        out.push_back(static_cast<int32_t>(id));
      }
    }
    for (const auto& [other, line] : chunk.names) add(of(other, line), line, out);
  }

  const std::vector<int32_t>& rows_of(const SetChunk& chunk) const {
    if (&sets_ == &scope_.node_sets) return scope_.nodes.ids;
    return scope_.cells[chunk.table].ids;
  }

  const Scope& scope_;
  const IdSets& sets_;
  const Source& source_;
  std::map<std::string, Entry> done_;
  int depth_ = 0;
};

}  // namespace

std::vector<int32_t> numbers_of_set(const Scope& scope, const IdSets& sets, const std::string& name,
                                    const Source& source, Origin origin) {
  return SetNumbers(scope, sets, source).of(name, origin);
}

}  // namespace clatter::mesh::deck::abaqus
