// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Look-up by name in a map; the error lists the existing names.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"

namespace clatter {

/// The entry `name` of `map`; InputError "`owner`: no `kind` named ..., expected one of: ..." when
/// there is none.
template <class Map>
const typename Map::mapped_type& find_named(const Map& map, std::string_view owner,
                                            std::string_view kind, std::string_view name) {
  const auto at = map.find(std::string(name));
  if (at != map.end()) return at->second;
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  throw InputError(fmt::format("{}: no {} named {}, expected one of: {}", owner, kind, name,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace clatter
