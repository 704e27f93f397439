// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/lines.hpp"

#include <fmt/format.h>

namespace clatter::mesh::deck::abaqus {
namespace {

// "* Solid  section" -> "*SOLID SECTION".
std::string display_name(std::string_view text) {
  std::string out = "*";
  bool blank = false;
  for (const char c : text) {
    if (c == ' ' || c == '\t') {
      blank = out.size() > 1;
      continue;
    }
    if (blank) out += ' ';
    blank = false;
    out += c;
  }
  return capitals(out);
}

std::string unquoted(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return std::string(text);
}

// First comma outside quotes.
size_t next_comma(std::string_view text) {
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == ',' && !quoted) return i;
  }
  return std::string_view::npos;
}

void add_parameters(std::string_view text, Keyword& keyword) {
  while (!text.empty()) {
    const size_t comma = next_comma(text);
    const std::string_view one = trimmed(text.substr(0, comma));
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    if (one.empty()) continue;
    const size_t equals = one.find('=');
    const bool flag = equals == std::string_view::npos;
    keyword.parameters.emplace_back(folded(one.substr(0, equals)),
                                    flag ? "" : unquoted(one.substr(equals + 1)));
  }
}

}  // namespace

bool Lines::next_line() {
  if (held_) {
    held_ = false;
    return true;
  }
  while (const auto line = source_.next()) {
    data_ = trimmed(*line);
    marked_end_ = data_ == kEndMark;
    marked_shells_ = marked_shells_ || data_ == kShellMark;
    if (data_.empty() || data_.starts_with("**")) continue;
    if (!parameters_.empty() && data_.find('<') != std::string_view::npos) {
      replaced_ = parameters_.replaced(data_, source_, source_.origin());
      data_ = replaced_;
    }
    return true;
  }
  return false;
}

Lines::Kind Lines::next() {
  while (next_line()) {
    bare_keyword_ = data_.front() == '*';
    if (!bare_keyword_) return Kind::kData;
    read_keyword();
    const std::string* file = keyword_.find("INPUT");
    if (file == nullptr && keyword_.key != "INCLUDE") return Kind::kKeyword;
    const std::string name = keyword_.required("INPUT", source_);
    if (held_) source_.fail(keyword_.origin, "found a comma after INPUT, expected the line's end");
    std::erase_if(keyword_.parameters, [](const auto& p) { return p.first == "INPUT"; });
    source_.include(name, keyword_.origin);
    if (keyword_.key != "INCLUDE") return Kind::kKeyword;
  }
  return Kind::kEnd;
}

// A trailing comma continues the line, unless data or the next keyword follows.
void Lines::read_keyword() {
  keyword_ = Keyword();
  keyword_.origin = source_.origin();
  std::string text(data_.substr(1));
  while (text.ends_with(',') && text.size() < kLongestLine) {
    if (!next_line()) {
      open_keyword_ = true;
      break;
    }
    const char first = data_.front();
    const bool word = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
    const bool equals = data_.find('=') != std::string_view::npos;
    if (!word || (!equals && text.find('=') == std::string::npos)) {
      held_ = true;
      break;
    }
    text += data_;
  }
  const size_t comma = next_comma(text);
  keyword_.name = display_name(trimmed(std::string_view(text).substr(0, comma)));
  keyword_.key = folded_keyword(keyword_.name);
  if (comma != std::string::npos) {
    add_parameters(std::string_view(text).substr(comma + 1), keyword_);
  }
}

}  // namespace clatter::mesh::deck::abaqus
