// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/source.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::mesh::deck::nastran {
namespace {

bool is_comment(std::string_view line) {
  const size_t at = line.find_first_not_of(" \t");
  return at == std::string_view::npos || line[at] == '$';
}

}  // namespace

Source::Source(const std::filesystem::path& deck)
    : LineSource(deck, kLongestLine, Listing::kOnce) {}

Source::Source(const std::string& name, std::string_view text)
    : LineSource(name, text, kLongestLine) {}

std::optional<std::string_view> Source::next() {
  if (again_) {
    again_ = false;
    return last_;
  }
  const auto line = next_line();
  if (!line) return std::nullopt;
  last_ = *line;
  if (at_first_line() && last_.starts_with("\xef\xbb\xbf")) last_.remove_prefix(3);
  if (last_.size() > kLongestLine && !is_comment(last_)) {
    fail(origin(), fmt::format("found a line of more than {} characters", kLongestLine));
  }
  return last_;
}

void Source::include(const std::string& name, Origin origin) {
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  std::vector<std::filesystem::path> candidates;
  const auto folders = written_folders();
  // The last line may have ended its file, which is still open.
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
    candidates.push_back(*folder / name);
    candidates.push_back(*folder / slashed);
  }
  LineSource::include("INCLUDE", name, candidates, origin);
}

}  // namespace clatter::mesh::deck::nastran
