// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace clatter::mesh::deck::nastran {
void Card::clear() {
  name_.clear();
  next_.clear();
  text_.clear();
  fields_.clear();
  lines_.clear();
}

void Card::start(const LineFields& line, Origin origin) {
  clear();
  append_capitals(line.head, name_);
  add(line, origin);
}

std::string Card::append(const LineFields& line, Origin origin) {
  if (!line.large && lines_.back().large && fields_.size() % 8 != 0) {
    return "found a small-field continuation after the first half of a large-field line, expected "
           "its second half, which begins with *";
  }
  add(line, origin);
  return {};
}

std::string Card::append(const Card& continuation) {
  if (!continuation.lines_.front().large && lines_.back().large && fields_.size() % 8 != 0) {
    return "found a small-field continuation of half a large-field line";
  }
  const auto shift = static_cast<uint32_t>(text_.size());
  const size_t first = fields_.size();
  text_ += continuation.text_;
  for (const Field& field : continuation.fields_) {
    fields_.push_back({field.begin + shift, field.length});
  }
  for (const Line& line : continuation.lines_) {
    lines_.push_back({line.field + first, line.origin, line.large});
  }
  next_ = continuation.next_;
  return {};
}

void Card::add(const LineFields& line, Origin origin) {
  if (text_.size() > std::numeric_limits<uint32_t>::max() / 2) fail(0, "the card is too long");
  lines_.push_back({fields_.size(), origin, line.large});
  for (const std::string_view text : line.data) {
    fields_.push_back({static_cast<uint32_t>(text_.size()), static_cast<uint32_t>(text.size())});
    append_capitals(text, text_);
  }
  next_ = capitals(line.next);
}

std::string_view Card::text(size_t i) const {
  if (i >= fields_.size()) return {};
  return std::string_view(text_).substr(fields_[i].begin, fields_[i].length);
}

bool Card::blank_from(size_t i) const {
  while (i < fields_.size() && fields_[i].length == 0) ++i;
  return i >= fields_.size();
}

void Card::fail(size_t i, const std::string& message) const {
  size_t line = 0;
  while (line + 1 < lines_.size() && lines_[line + 1].field <= i) ++line;
  source_->fail(lines_[line].origin, fmt::format("{}: {}", name_, message));
}

std::string_view Card::word(size_t i, const char* what) const {
  if (text(i).find(' ') != std::string_view::npos) fail_expected(i, what, "one word");
  return text(i);
}

void Card::fail_expected(size_t i, const char* what, const char* expected) const {
  if (text(i).find(' ') != std::string_view::npos)
    fail(i, fmt::format("{}: found {}, parts of two fields: align the fields of this line in "
                        "columns of 8 (of 16 with *), or separate them by commas",
                        what, shown(text(i))));
  if (blank(i)) fail(i, fmt::format("{}: found nothing, expected {}", what, expected));
  fail(i, fmt::format("{}: found {}, expected {}", what, shown(text(i)), expected));
}

void Card::at_most(size_t count) const {
  for (size_t i = count; i < fields_.size(); ++i) {
    if (!blank(i)) fail(i, fmt::format("found {} after the last field", shown(text(i))));
  }
}

double Card::number(size_t i, const char* what) const {
  const auto value = to_number(text(i));
  if (!value) fail_expected(i, what, "a number");
  return *value;
}

double Card::number_or(size_t i, const char* what, double fallback) const {
  return blank(i) ? fallback : number(i, what);
}

int32_t Card::id(size_t i, const char* what) const {
  const auto value = to_integer(text(i));
  if (!value || *value < 1) fail_expected(i, what, "an integer from 1 to 2147483647");
  return *value;
}

int32_t Card::id_or(size_t i, const char* what, int32_t fallback) const {
  return blank(i) ? fallback : id(i, what);
}

int32_t Card::integer(size_t i, const char* what) const {
  const auto value = to_integer(text(i));
  if (!value) fail_expected(i, what, "an integer");
  return *value;
}

int32_t Card::integer_or(size_t i, const char* what, int32_t fallback) const {
  return blank(i) ? fallback : integer(i, what);
}

DofMask Card::components(size_t i, const char* what) const {
  const DofMask mask = components_or_none(i, what);
  if (mask == 0) fail_expected(i, what, "some of the digits 1 to 6");
  return mask;
}

DofMask Card::components_or_none(size_t i, const char* what) const {
  unsigned mask = 0;
  if (text(i) == "0") return 0;
  for (char c : text(i)) {
    const unsigned bit = c >= '1' && c <= '6' ? 1u << (c - '1') : 0;
    if (bit == 0 || (mask & bit) != 0) fail_expected(i, what, "digits 1 to 6, each at most once");
    mask |= bit;
  }
  return static_cast<DofMask>(mask);
}

bool Card::is_word(size_t i) const {
  const auto word = text(i);
  return !word.empty() && word[0] >= 'A' && word[0] <= 'Z';
}

// THRU b EXCEPT c, d THRU e: numbers up to the first that is outside the range; returns the last
// field.
size_t Card::leave_out(size_t i, const char* what, IdList& list) const {
  const IdRange whole = list.back();
  if (whole.step != 1) fail(i, "BY and EXCEPT exclude each other");
  for (; i < size(); ++i) {
    if (blank(i)) continue;
    if (!is_integer(i)) break;
    const int32_t first = id(i, what);
    if (first < whole.first || first > whole.last) break;
    int32_t last = first;
    if (text(i + 1) == "THRU") last = std::min(id(i += 2, what), whole.last);
    const IdRange open = list.back();
    if (first < open.first || last < first)
      fail(i, fmt::format("found {} after EXCEPT, expected ascending numbers", first));
    list.pop_back();
    if (first > open.first) list.push_back({open.first, first - 1, 1, true});
    if (last == whole.last) return i;
    list.push_back({last + 1, open.last, 1, true});
  }
  return i - 1;
}

IdList Card::ids(size_t i, const char* what, size_t* end) const {
  IdList list;
  for (; i < size(); ++i) {
    if (blank(i)) continue;
    if (is_integer(i)) {
      const int32_t one = id(i, what);
      list.push_back({one, one});
    } else if (text(i) == "THRU" && !list.empty() && !list.back().is_range) {
      while (++i < size() && blank(i)) {
      }
      list.back().last = id(i, what);
      list.back().is_range = true;
      if (list.back().last < list.back().first) {
        fail(i, fmt::format("found {} THRU {}, expected the smaller number first",
                            list.back().first, list.back().last));
      }
    } else if (text(i) == "BY" && !list.empty() && list.back().is_range) {
      list.back().step = id(++i, "BY");
    } else if (text(i) == "EXCEPT" && !list.empty() && list.back().is_range) {
      i = leave_out(i + 1, what, list);
    } else {
      break;
    }
  }
  if (end) {
    *end = i;
  } else if (i < size()) {
    fail_expected(i, what, "an integer from 1 to 2147483647");
  }
  return list;
}

}  // namespace clatter::mesh::deck::nastran
