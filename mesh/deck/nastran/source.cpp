// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

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
  const auto next_to_decks = [&](const std::filesystem::path& file) {
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder)
      candidates.push_back(*folder / file);
  };
  next_to_decks(name);
  next_to_decks(slashed);
  // 'DIR:file': a folder that is an environment variable, as Nastran has it; else next to the deck.
  const size_t colon = slashed.find(':');
  if (colon != std::string::npos && colon > 1) {
    const std::string file = slashed.substr(colon + 1);
    if (const char* folder = std::getenv(slashed.substr(0, colon).c_str()))
      candidates.push_back(std::filesystem::path(folder) / file);
    next_to_decks(file);
    next_to_decks(slashed.substr(0, colon) + "/" + file);
  }
  LineSource::include("INCLUDE", name, candidates, origin);
}

}  // namespace clatter::mesh::deck::nastran
