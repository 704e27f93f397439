// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/source.hpp"

#include <fmt/format.h>

#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::abaqus {

Source::Source(const std::filesystem::path& deck)
    : LineSource(deck, kLongestLine, Listing::kEach) {}

Source::Source(const std::string& name, std::string_view text)
    : LineSource(name, text, kLongestLine) {}

std::optional<std::string_view> Source::next() {
  const auto line = next_line();
  if (line && line->size() >= kLongestLine) {
    throw BrokenDeck(
        fmt::format("{}: found a line of more than {} characters", where(origin()), kLongestLine));
  }
  return line;
}

void Source::include(const std::string& name, Origin origin) {
  std::vector<std::filesystem::path> candidates = {name};
  if (candidates.front().is_relative()) {
    candidates = {std::filesystem::path(files().front()).parent_path() / name};
    // A deck that is a text has no folder.
    if (!real_folders().empty())
      candidates.insert(candidates.begin(), real_folders().back() / name);
  }
  LineSource::include("*INCLUDE", name, candidates, origin);
}

}  // namespace clatter::mesh::deck::abaqus
