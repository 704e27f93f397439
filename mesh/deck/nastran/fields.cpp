// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/fields.hpp"

#include <fmt/format.h>

#include <cstring>

#include "mesh/deck/field_text.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr size_t kHeadWidth = 8, kDataEnd = 72, kLineEnd = 80;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

void expand_tabs(std::string_view line, std::string& out) {
  out.clear();
  for (char c : line) {
    if (c == '\t') {
      out.append(8 - out.size() % 8, ' ');
    } else {
      out += c;
    }
  }
}

// Continuation names are compared without their + or *; some programs number them "+000001", so
// that the next line begins with two.
std::string_view continuation_name(std::string_view text) {
  text = trimmed(text);
  while (!text.empty() && (text[0] == '+' || text[0] == '*')) text = trimmed(text.substr(1));
  return text;
}

void take_head(std::string_view head, LineFields& out) {
  head = trimmed(head);
  out.continuation = head.empty() || head[0] == '+' || head[0] == '*';
  if (out.continuation) {
    out.large = !head.empty() && head[0] == '*';
    out.head = continuation_name(head);
  } else {
    out.large = head.ends_with('*');
    out.head = out.large ? trimmed(head.substr(0, head.size() - 1)) : head;
  }
}

void split_fixed(std::string_view line, LineFields& out) {
  line = line.substr(0, kLineEnd);
  take_head(line.substr(0, kHeadWidth), out);
  const size_t width = out.large ? 16 : 8;
  for (size_t at = kHeadWidth; at < kDataEnd; at += width) {
    out.data.push_back(at < line.size() ? trimmed(line.substr(at, width)) : std::string_view{});
  }
  if (line.size() > kDataEnd) out.next = continuation_name(line.substr(kDataEnd));
}

// Field 10 of a free line: + or * and a name, a word, or nothing. A number there is an extra data
// field.
bool is_marker(std::string_view text) {
  if (text.empty() || text[0] == '+' || text[0] == '*') return true;
  return !is_digit(text[0]) && text[0] != '-' && text[0] != '.';
}

std::string split_free(std::string_view line, LineFields& out) {
  size_t comma = line.find(',');
  take_head(line.substr(0, comma), out);
  const size_t per_line = out.large ? 4 : 8;
  size_t filled = 0;  // data fields of the current line of the card
  while (comma != std::string_view::npos) {
    const size_t begin = comma + 1;
    comma = line.find(',', begin);
    const auto text = trimmed(line.substr(begin, comma - begin));
    if (filled < per_line) {
      out.data.push_back(text);
      ++filled;
      continue;
    }
    if (!is_marker(text)) {
      return fmt::format(
          "found {} as field {} of a free-field line, expected a continuation (+) "
          "after {} data fields",
          shown(text), per_line + 2, per_line);
    }
    out.next = continuation_name(text);
    filled = 0;
    if (comma == std::string_view::npos) return {};
  }
  if (filled > 0) out.next = {};
  while (filled > 0 && filled < per_line) {
    out.data.emplace_back();
    ++filled;
  }
  return {};
}

}  // namespace

std::string_view without_comment(std::string_view line) {
  const void* dollar = line.empty() ? nullptr : std::memchr(line.data(), '$', line.size());
  if (dollar)
    line = line.substr(0, static_cast<size_t>(static_cast<const char*>(dollar) - line.data()));
  while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
  return line;
}

std::string split_line(std::string_view line, LineFields& out) {
  out.data.clear();
  out.next = {};
  if (line.substr(0, kDataEnd).find(',') != std::string_view::npos) return split_free(line, out);
  if (line.find('\t') != std::string_view::npos) {
    expand_tabs(line, out.expanded);
    line = out.expanded;
  }
  split_fixed(line, out);
  return {};
}

}  // namespace clatter::mesh::deck::nastran
