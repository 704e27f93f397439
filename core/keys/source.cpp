// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/source.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::keys {

void Source::fail(std::string_view key, const std::string& message) const {
  if (table_) table_->fail(key, message);
  throw InputError(fmt::format("{}{}{}: {}", where_, where_.empty() ? "" : ": ", key, message));
}

Source Source::below(std::string_view key) const {
  return table_ && table_->has(key) ? Source(table_->table(key)) : *this;
}

std::string Source::comment(const std::string& key) const {
  const auto found = remarks_.find(key);
  if (found != remarks_.end()) return "  # " + found->second;
  return key.empty() && !where_.empty() ? "  # " + where_ : "";
}

}  // namespace clatter::keys
