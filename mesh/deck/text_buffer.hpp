// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Text of a deck that is written in large pieces.
#include <fmt/format.h>

#include <iterator>
#include <ostream>
#include <utility>

namespace clatter::mesh::deck {

class TextBuffer {
 public:
  explicit TextBuffer(std::ostream& out) : out_(out) {}

  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    if (text_.size() > kFlushAt) flush();
  }
  /// Writes what is left: after the last put().
  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

 private:
  static constexpr size_t kFlushAt = size_t{1} << 20;
  std::ostream& out_;
  fmt::memory_buffer text_;
};

}  // namespace clatter::mesh::deck
