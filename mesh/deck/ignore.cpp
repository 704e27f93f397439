// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/ignore.hpp"

namespace clatter::mesh::deck {

Ignore::Ignore(const ReadOptions& options, Key key) : key_(key) {
  for (const std::string& name : options.ignore) names_.insert(key_(name));
}

bool Ignore::skips(std::string_view name, int64_t times) {
  if (!lists(name)) return false;
  if (times > 0) counted_[std::string(name)] += times;
  return true;
}

}  // namespace clatter::mesh::deck
