// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/contents.hpp"

#include <fmt/format.h>

namespace clatter::mesh::deck {

Content& Contents::count(std::string_view kind, std::string_view name, const LineSource& source,
                         Origin origin, int64_t times) {
  if (last_ == nullptr || last_->name != name || last_->kind != kind) {
    Content*& known = by_name_[fmt::format("{} {}", kind, name)];
    if (known == nullptr) {
      rows_.push_back(
          {std::string(kind), std::string(name), Fate::kRead, "", 0, source.where(origin)});
      known = &rows_.back();
    }
    last_ = known;
  }
  last_->count += times;
  return *last_;
}

}  // namespace clatter::mesh::deck
