// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/contents.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

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

void Contents::pass(std::string_view kind, std::string_view name, const LineSource& source,
                    Origin origin, std::string_view why, int64_t times) {
  Content& content = count(kind, name, source, origin, times);
  content.fate = Fate::kPassed;
  content.meaning = why;
}

std::string Contents::passed_line() const {
  std::map<std::string_view, std::vector<std::string>> by_reason;
  for (const Content& one : rows_)
    if (one.fate == Fate::kPassed)
      by_reason[one.meaning.empty() ? one.kind : one.meaning].push_back(
          one.count == 1 ? one.name : fmt::format("{} ({})", one.name, one.count));
  std::vector<std::string> parts;
  for (const auto& [reason, names] : by_reason)
    parts.push_back(fmt::format("{}: {}", reason, fmt::join(names, ", ")));
  if (parts.empty()) return {};
  return fmt::format("passed over, since neither stiffness nor mass depends on it: {}",
                     fmt::join(parts, "; "));
}

}  // namespace clatter::mesh::deck
