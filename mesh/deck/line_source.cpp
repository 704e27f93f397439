// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/line_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/base/planned_files.hpp"
#include "mesh/deck/field_text.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck {
namespace {

namespace fs = std::filesystem;

constexpr size_t kSmallestBuffer = size_t{1} << 18;
constexpr size_t kDeepest = 64;
constexpr int kMostIncludes = 10000;

}  // namespace

struct LineSource::Stream {
  fs::path path;  // canonical: detects cycles through links
  size_t file = 0;
  Origin line = 0;  // lines returned so far
  std::ifstream in;
  std::vector<char> buffer;
  size_t begin = 0, end = 0;
  bool at_end = false;

  // Moves the rest to the front and refills.
  void refill() {
    std::memmove(buffer.data(), buffer.data() + begin, end - begin);
    end -= begin;
    begin = 0;
    in.read(buffer.data() + end, static_cast<std::streamsize>(buffer.size() - end));
    end += static_cast<size_t>(in.gcount());
    at_end = !in;
    if (in.bad()) throw FileError(fmt::format("{}: cannot be read", path.string()));
  }

  // A line that does not fit into the buffer is cut to longest + 1 characters.
  std::optional<std::string_view> next(size_t longest) {
    bool cut = false;
    for (size_t seen = 0;;) {
      char* from = buffer.data() + begin;
      const void* newline =
          begin + seen < end ? std::memchr(from + seen, '\n', end - begin - seen) : nullptr;
      const size_t length =
          newline ? static_cast<size_t>(static_cast<const char*>(newline) - from) : end - begin;
      if (newline || at_end) {
        if (!newline && length == 0 && !cut) return std::nullopt;
        begin += length + (newline ? 1 : 0);
        return cut ? head_ : std::string_view(from, length);
      }
      seen = length;
      if (length == buffer.size()) {
        if (!cut) head_.assign(from, longest + 1);
        cut = true;
        begin = end;
        seen = 0;
      }
      refill();
    }
  }

 private:
  std::string head_;
};

LineSource::LineSource(const fs::path& deck, size_t longest, Listing listing)
    : longest_(longest), listing_(listing) {
  if (!fs::is_regular_file(deck)) throw FileError(fmt::format("{}: no such file", deck.string()));
  open(deck);
}

LineSource::LineSource(const std::string& name, std::string_view text, size_t longest)
    : longest_(longest), in_memory_(true) {
  auto stream = std::make_unique<Stream>();
  stream->file = add_file(name);
  stream->buffer.assign(text.begin(), text.end());
  stream->end = text.size();
  stream->at_end = true;
  streams_.push_back(std::move(stream));
  begin_segment();
}

LineSource::~LineSource() = default;

void LineSource::open(const fs::path& path) {
  will_read(path);
  auto stream = std::make_unique<Stream>();
  std::error_code trouble;
  stream->path = fs::canonical(path, trouble);
  stream->in.open(path, std::ios::binary);
  if (trouble || !stream->in) throw FileError(fmt::format("{}: cannot be read", path.string()));
  stream->file =
      add_file(listing_ == Listing::kOnce ? path.lexically_normal().string() : path.string());
  stream->buffer.resize(std::max(kSmallestBuffer, longest_ + 1));
  streams_.push_back(std::move(stream));
  begin_segment();
}

size_t LineSource::add_file(const std::string& name) {
  const auto known =
      listing_ == Listing::kOnce ? std::find(files_.begin(), files_.end(), name) : files_.end();
  if (known != files_.end()) return static_cast<size_t>(known - files_.begin());
  files_.push_back(name);
  return files_.size() - 1;
}

void LineSource::begin_segment() {
  segments_.push_back({count_, streams_.back()->file, streams_.back()->line});
}

std::optional<std::string_view> LineSource::next_line() {
  while (!streams_.empty()) {
    Stream& stream = *streams_.back();
    if (auto line = stream.next(longest_)) {
      if (count_ == std::numeric_limits<Origin>::max()) {
        throw BrokenDeck(where(origin()) + ": the deck has too many lines");
      }
      ++count_;
      ++stream.line;
      if (line->ends_with('\r')) line->remove_suffix(1);
      return line;
    }
    streams_.pop_back();
    if (!streams_.empty()) begin_segment();
  }
  return std::nullopt;
}

bool LineSource::at_first_line() const { return !streams_.empty() && streams_.back()->line == 1; }

std::vector<fs::path> LineSource::written_folders() const {
  std::vector<fs::path> folders;
  for (const auto& stream : streams_) {
    folders.push_back(fs::path(files_[stream->file]).parent_path());
  }
  return folders;
}

std::vector<fs::path> LineSource::real_folders() const {
  std::vector<fs::path> folders;
  for (const auto& stream : streams_) folders.push_back(stream->path.parent_path());
  return folders;
}

void LineSource::include(std::string_view statement, const std::string& name,
                         const std::vector<fs::path>& candidates, Origin origin) {
  if (in_memory_) {
    fail(origin, fmt::format("{} is not possible here: the deck is not a file", statement));
  }
  if (streams_.size() >= kDeepest) {
    fail(origin, fmt::format("found {} more than {} files deep", statement, kDeepest));
  }
  if (++includes_ > kMostIncludes) {
    fail(origin, fmt::format("found more than {} {} statements", kMostIncludes, statement));
  }
  std::error_code trouble;
  for (const fs::path& path : candidates) {
    if (!fs::is_regular_file(path, trouble)) continue;
    const fs::path canonical = fs::canonical(path, trouble);
    for (const auto& outer : streams_) {
      if (outer->path != canonical) continue;
      fail(origin, fmt::format("{} {}: this file includes itself", statement, shown(name)));
    }
    return open(path);
  }
  fail(origin, fmt::format("{} {}: found no such file next to this one or those that include it",
                           statement, shown(name)));
}

std::string LineSource::where(Origin origin) const {
  const auto after = std::upper_bound(segments_.begin(), segments_.end(), origin,
                                      [](Origin o, const Segment& s) { return o < s.first; });
  const Segment& segment = after == segments_.begin() ? *after : *std::prev(after);
  return fmt::format("{}:{}", files_[segment.file], segment.line + (origin - segment.first) + 1);
}

void LineSource::fail(Origin origin, const std::string& message) const {
  throw InputError(fmt::format("{}: {}", where(origin), message));
}

}  // namespace clatter::mesh::deck
