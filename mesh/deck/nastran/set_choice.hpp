// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Active sets: SPC and MPC sets, their sums (SPCADD, MPCADD) and the selection by a case control.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {

/// Sets that belong to no sum, and the sums.
template <class Sets>
std::set<int32_t> top_sets(const Sets& sets, const std::map<int32_t, SetSum>& sums) {
  std::set<int32_t> top;
  for (const auto& [id, set] : sets) top.insert(id);
  for (const auto& [id, sum] : sums) {
    for (const IdRange& range : sum.sets) {
      top.erase(top.lower_bound(range.first), top.upper_bound(range.last));
    }
  }
  for (const auto& [id, sum] : sums) top.insert(id);
  return top;
}

/// The one set of a deck without case control; 0 if there is none. InputError that names them if
/// there are several.
template <class Sets>
int32_t only_set(const Model& model, const char* card, const Sets& sets,
                 const std::map<int32_t, SetSum>& sums) {
  const std::set<int32_t> top = top_sets(sets, sums);
  if (top.empty()) return 0;
  if (top.size() == 1) return *top.begin();
  std::string names;
  for (auto at = top.begin(); at != top.end() && names.size() < 60; ++at) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", *at);
  }
  throw InputError(
      fmt::format("{}: found {} {} sets ({}), expected {} = n in a case control that "
                  "chooses one",
                  model.source.files().front(), top.size(), card, names, card));
}

/// The sets in `chosen`: itself, or the terms of its sum; a term that is missing is said.
/// InputError when nothing is left.
template <class Sets>
std::vector<int32_t> members_of(Model& model, const char* card, int32_t chosen, const Sets& sets,
                                const std::map<int32_t, SetSum>& sums, Origin origin) {
  const auto sum = sums.find(chosen);
  if (sum == sums.end()) {
    if (sets.contains(chosen)) return {chosen};
    model.source.fail(origin, fmt::format("{} = {}: found no such set", card, chosen));
  }
  std::set<int32_t> members;
  std::vector<std::string> missing;
  for (const IdRange& range : sum->second.sets) {
    if (!range.is_range && !sets.contains(range.first)) {
      missing.push_back(
          fmt::format("{}ADD {}: found no {} set {}", card, chosen, card, range.first));
    }
    for (auto at = sets.lower_bound(range.first); at != sets.end() && at->first <= range.last;
         ++at) {
      members.insert(at->first);
    }
  }
  if (members.empty() && !missing.empty()) model.source.fail(sum->second.origin, missing.front());
  for (const std::string& text : missing) {
    const std::string note =
        fmt::format("{}: {}: it is left out", model.source.where(sum->second.origin), text);
    auto& notes = model.deck.notes;
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
  return {members.begin(), members.end()};
}

}  // namespace clatter::mesh::deck::nastran
