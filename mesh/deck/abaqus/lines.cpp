// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/lines.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return out;
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

void add_parameters(std::string_view text, Keyword* keyword) {
  while (!text.empty()) {
    const size_t comma = next_comma(text);
    const std::string_view one = trimmed(text.substr(0, comma));
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    if (one.empty()) continue;
    const size_t equals = one.find('=');
    const bool flag = equals == std::string_view::npos;
    keyword->parameters.emplace_back(folded(one.substr(0, equals)),
                                     flag ? "" : unquoted(one.substr(equals + 1)));
  }
}

}  // namespace

Ignore::Ignore(const ReadOptions& options) {
  for (const std::string& name : options.ignore) {
    std::string key = folded(name);
    if (!key.empty() && key.front() == '*') key.erase(0, 1);
    names_.insert(key);
  }
}

bool Ignore::skips(const std::string& name, int64_t times) {
  std::string key = folded(name);
  if (!key.empty() && key.front() == '*') key.erase(0, 1);
  if (!names_.contains(key)) return false;
  counted_[name] += times;
  return true;
}

const std::string* Keyword::find(std::string_view parameter) const {
  for (const auto& [name_of, value] : parameters) {
    if (name_of == parameter) return &value;
  }
  return nullptr;
}

std::string Keyword::choice(std::string_view parameter, const std::string& fallback) const {
  const std::string* value = find(parameter);
  return value != nullptr ? folded(*value) : fallback;
}

const std::string& Keyword::required(std::string_view parameter, const Source& source) const {
  const std::string* value = find(parameter);
  if (value == nullptr || value->empty()) {
    source.fail(spot, fmt::format("{}: expected the parameter {}=", name, parameter));
  }
  return *value;
}

void Keyword::allow(std::initializer_list<std::string_view> known, const Source& source,
                    Ignore* ignore) const {
  for (const auto& [parameter, value] : parameters) {
    if (std::find(known.begin(), known.end(), parameter) != known.end()) continue;
    if (ignore->skips(parameter)) continue;
    source.fail(spot, fmt::format("{} with the parameter {} is not supported; ignore = [\"{}\"] "
                                  "reads it without the parameter",
                                  name, parameter, parameter));
  }
}

bool Lines::next_line() {
  if (held_) {
    held_ = false;
    return true;
  }
  std::string_view line;
  while (source_->next(&line)) {
    data_ = trimmed(line);
    marked_end_ = data_ == kEndMark;
    if (!data_.empty() && !data_.starts_with("**")) return true;
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
    const std::string name = keyword_.required("INPUT", *source_);
    if (held_) source_->fail(keyword_.spot, "found a comma after INPUT, expected the line's end");
    std::erase_if(keyword_.parameters, [](const auto& p) { return p.first == "INPUT"; });
    source_->include(name, keyword_.spot);
    if (keyword_.key != "INCLUDE") return Kind::kKeyword;
  }
  return Kind::kEnd;
}

// A trailing comma continues the line, unless data or the next keyword follows.
void Lines::read_keyword() {
  keyword_ = Keyword();
  keyword_.spot = source_->spot();
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
  keyword_.key = folded(std::string_view(keyword_.name).substr(1));
  if (comma != std::string::npos) {
    add_parameters(std::string_view(text).substr(comma + 1), &keyword_);
  }
}

void Card::add(std::string_view line, Spot spot) {
  text_ += line;
  lines_.push_back({text_.size(), spot});
}

Fields Card::line(size_t i, const Source& source) const {
  const size_t begin = i == 0 ? 0 : lines_[i - 1].end;
  return Fields(std::string_view(text_).substr(begin, lines_[i].end - begin), source,
                lines_[i].spot);
}

}  // namespace clatter::mesh::deck::abaqus
