// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The names that the user ignores, and how often each was found.
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

class Ignore {
 public:
  /// `key`: the form in which a format compares names.
  using Key = std::string (*)(std::string_view name);
  Ignore(const ReadOptions& options, Key key);

  /// True when the user ignores `name`.
  bool lists(std::string_view name) const { return names_.contains(key_(name)); }
  /// The same, and counted `times` under `name`.
  bool skips(std::string_view name, int64_t times = 1);
  /// Those that were found.
  const std::map<std::string, int64_t>& counted() const { return counted_; }

 private:
  Key key_;
  std::set<std::string> names_;
  std::map<std::string, int64_t> counted_;
};

}  // namespace clatter::mesh::deck
