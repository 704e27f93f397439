// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/planned_files.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr size_t kLongestLine = 65536;
constexpr size_t kPiece = 4 * kLongestLine;
constexpr size_t kDeepest = 64;
constexpr int kMostIncludes = 10000;

bool is_comment(std::string_view line) {
  const size_t at = line.find_first_not_of(" \t");
  return at == std::string_view::npos || line[at] == '$';
}

}  // namespace

struct Source::Stream {
  std::filesystem::path path;  // canonical: detects cycles through links
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
  }

  // A line that does not fit into the buffer is truncated.
  std::optional<std::string_view> next() {
    bool cut = false;
    std::string_view first;
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
        if (!cut) head_.assign(from, kLongestLine + 1);
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

Source::Source(const std::filesystem::path& deck) {
  if (!std::filesystem::is_regular_file(deck)) {
    throw FileError(fmt::format("{}: no such file", deck.string()));
  }
  open(deck);
}

Source::Source(const std::string& name, std::string_view text) : in_memory_(true) {
  auto stream = std::make_unique<Stream>();
  stream->file = file_index(name);
  stream->buffer.assign(text.begin(), text.end());
  stream->end = text.size();
  stream->at_end = true;
  streams_.push_back(std::move(stream));
  start_segment();
}

Source::~Source() = default;

void Source::open(const std::filesystem::path& path) {
  will_read(path);
  auto stream = std::make_unique<Stream>();
  std::error_code trouble;
  stream->path = std::filesystem::canonical(path, trouble);
  stream->in.open(path, std::ios::binary);
  if (trouble || !stream->in) {
    throw FileError(fmt::format("{}: cannot be read", path.string()));
  }
  stream->file = file_index(path.lexically_normal().string());
  stream->buffer.resize(kPiece);
  streams_.push_back(std::move(stream));
  start_segment();
}

size_t Source::file_index(const std::string& name) {
  const auto at = std::find(files_.begin(), files_.end(), name);
  if (at != files_.end()) return static_cast<size_t>(at - files_.begin());
  files_.push_back(name);
  return files_.size() - 1;
}

void Source::start_segment() {
  segments_.push_back({count_, streams_.back()->file, streams_.back()->line});
}

std::optional<std::string_view> Source::next() {
  if (again_) {
    again_ = false;
    return last_;
  }
  while (!streams_.empty()) {
    Stream& stream = *streams_.back();
    if (const auto line = stream.next()) {
      if (count_ == std::numeric_limits<Origin>::max())
        fail(origin(), "the deck has too many lines");
      ++count_;
      ++stream.line;
      last_ = *line;
      if (stream.line == 1 && last_.starts_with("\xef\xbb\xbf")) last_.remove_prefix(3);
      if (last_.ends_with('\r')) last_.remove_suffix(1);
      if (last_.size() > kLongestLine && !is_comment(last_)) {
        fail(origin(), fmt::format("found a line of more than {} characters", kLongestLine));
      }
      return last_;
    }
    streams_.pop_back();
    if (!streams_.empty()) start_segment();
  }
  return std::nullopt;
}

void Source::include(const std::string& name) {
  if (in_memory_) fail(origin(), "INCLUDE is not possible here: the deck is not a file");
  if (streams_.size() >= kDeepest) {
    fail(origin(), fmt::format("found INCLUDE more than {} files deep", kDeepest));
  }
  if (++includes_ > kMostIncludes) {
    fail(origin(), fmt::format("found more than {} INCLUDE statements", kMostIncludes));
  }
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  std::error_code trouble;
  // The last line may have ended its file, which is still open.
  for (auto stream = streams_.rbegin(); stream != streams_.rend(); ++stream) {
    const auto folder = std::filesystem::path(files_[(*stream)->file]).parent_path();
    for (const std::string& spelling : {name, slashed}) {
      const auto path = folder / spelling;
      if (!std::filesystem::is_regular_file(path, trouble)) continue;
      const auto canonical = std::filesystem::canonical(path, trouble);
      for (const auto& outer : streams_) {
        if (outer->path == canonical) {
          fail(origin(), fmt::format("INCLUDE {}: this file includes itself", shown(name)));
        }
      }
      return open(path);
    }
  }
  fail(origin(),
       fmt::format("INCLUDE {}: found no such file next to this one or those that include it",
                   shown(name)));
}

std::string Source::where(Origin origin) const {
  const auto after = std::upper_bound(segments_.begin(), segments_.end(), origin,
                                      [](Origin o, const Segment& s) { return o < s.first; });
  const Segment& segment = *std::prev(after);
  return fmt::format("{}:{}", files_[segment.file], segment.line + (origin - segment.first) + 1);
}

void Source::fail(Origin origin, const std::string& message) const {
  throw InputError(fmt::format("{}: {}", where(origin), message));
}

std::string shown(std::string_view text) {
  std::string out = "'";
  for (char c : text.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > 40 ? "...'" : "'");
}

}  // namespace clatter::mesh::deck::nastran
