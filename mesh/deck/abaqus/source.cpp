// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/base/planned_files.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::abaqus {
namespace fs = std::filesystem;

Source::Source(const fs::path& deck) { open(deck); }

Source::Source(std::string_view text, const std::string& name) : in_memory_(true) {
  files_.push_back(name);
  OpenFile file;
  file.text = text;
  file.at_end = true;
  open_.push_back(std::move(file));
  begin_segment();
}

void Source::open(const fs::path& path) {
  will_read(path);
  std::error_code trouble;
  const fs::path canonical = fs::weakly_canonical(path, trouble);
  OpenFile file;
  file.path = trouble ? path : canonical;
  file.stream.reset(std::fopen(path.c_str(), "rb"));
  if (!file.stream) throw FileError(fmt::format("{}: cannot be opened", path.string()));
  file.name = static_cast<int32_t>(files_.size());
  files_.push_back(path.string());
  open_.push_back(std::move(file));
  begin_segment();
}

void Source::begin_segment() {
  segments_.push_back({lines_, open_.back().name, open_.back().line});
}

// Moves the rest of the text to the front and reads more; false at the end.
bool Source::refill(OpenFile& file) {
  if (file.at_end) return false;
  const size_t rest = file.text.size();
  if (file.kept.empty()) file.kept.resize(kLongestLine);
  if (rest > 0) std::memmove(file.kept.data(), file.text.data(), rest);
  const size_t came =
      std::fread(file.kept.data() + rest, 1, file.kept.size() - rest, file.stream.get());
  if (std::ferror(file.stream.get()) != 0) {
    throw FileError(fmt::format("{}: cannot be read", files_[static_cast<size_t>(file.name)]));
  }
  file.text = std::string_view(file.kept.data(), rest + came);
  file.at_end = came == 0;
  return came > 0;
}

bool Source::next(std::string_view* line) {
  while (!open_.empty()) {
    OpenFile& file = open_.back();
    size_t end = file.text.find('\n');
    while (end == std::string_view::npos && file.text.size() < kLongestLine && refill(file)) {
      end = file.text.find('\n');
    }
    if (end == std::string_view::npos && file.text.empty()) {
      open_.pop_back();
      if (!open_.empty()) begin_segment();
      continue;
    }
    ++file.line;
    ++lines_;
    if (lines_ > std::numeric_limits<Spot>::max() ||
        std::min(end, file.text.size()) >= kLongestLine) {
      lines_ = std::min<int64_t>(lines_, std::numeric_limits<Spot>::max());
      throw BrokenDeck(fmt::format("{}: found a line of more than {} characters, or too many lines",
                                   where(spot()), kLongestLine));
    }
    *line = file.text.substr(0, end);
    file.text.remove_prefix(end == std::string_view::npos ? file.text.size() : end + 1);
    if (!line->empty() && line->back() == '\r') line->remove_suffix(1);
    return true;
  }
  return false;
}

std::string Source::where(Spot spot) const {
  const auto after =
      std::upper_bound(segments_.begin(), segments_.end(), int64_t{spot},
                       [](int64_t line, const Segment& segment) { return line < segment.first; });
  const Segment& segment = after == segments_.begin() ? *after : *(after - 1);
  return fmt::format("{}:{}", files_[static_cast<size_t>(segment.file)],
                     segment.line + (spot - segment.first) + 1);
}

void Source::include(const std::string& name, Spot spot) {
  if (in_memory_) fail(spot, "*INCLUDE is not read in a deck without a file");
  if (open_.size() >= kDeepestInclude) {
    fail(spot, fmt::format("found more than {} nested files", kDeepestInclude));
  }
  std::error_code trouble;
  fs::path path(name);
  if (path.is_relative()) {
    const fs::path sibling = open_.back().path.parent_path() / path;
    const fs::path top = fs::path(files_.front()).parent_path() / path;
    path = fs::exists(sibling, trouble) ? sibling : top;
  }
  if (!fs::is_regular_file(path, trouble)) {
    fail(spot, fmt::format("*INCLUDE: there is no file '{}'", name));
  }
  const fs::path canonical = fs::weakly_canonical(path, trouble);
  for (const OpenFile& file : open_) {
    if (file.path == canonical) fail(spot, fmt::format("*INCLUDE: '{}' includes itself", name));
  }
  open(path);
}

}  // namespace clatter::mesh::deck::abaqus
