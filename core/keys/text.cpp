// SPDX-License-Identifier: GPL-3.0-or-later
// Structs as TOML for people.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "core/keys/member.hpp"
#include "core/keys/table.hpp"

namespace clatter::keys {
namespace {

/// "[1, 2, 3]" with a row of the lower triangle on each line.
std::string in_rows(const std::string& list) {
  std::string rows = "[\n ";
  size_t row = 1, column = 0;
  for (const char c : list.substr(1, list.size() - 2)) {
    rows += rows.size() == 3 ? std::string(1, ' ') + c : std::string(1, c);
    if (c == ',' && ++column == row) {
      rows += "\n ";
      column = 0;
      ++row;
    }
  }
  return rows + ",\n]";
}

/// A number outside its range where the text of a row has none: reading refuses it.
std::optional<double> refused(const Key& key, const std::byte* object) {
  const bool counts = key.outside && (key.required || !key.standard.empty());
  return counts ? key.outside(key, object + key.offset) : std::nullopt;
}

/// A value, with lengths in the file's unit.
std::string value_text(const Key& key, const std::byte* object, double metre) {
  Key scaled = key;
  if (key.unit.of_file) scaled.unit.scale *= metre;
  const std::string text = key.written(scaled, object + key.offset);
  return text.empty() ? fmt::format("{}", *refused(scaled, object)) : text;
}

}  // namespace

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<int>(static_cast<unsigned char>(c)));
    else
      out += c;
  }
  return out + '"';
}

std::string toml_key(std::string_view text) {
  const bool bare = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
  return bare ? std::string(text) : toml_text(text);
}

const Source& Table::source_of(const std::byte* object, const Source& other) const {
  return source_ ? *reinterpret_cast<const Source*>(object + *source_) : other;
}

bool Table::has_text(const Key& key, const std::byte* object) const {
  if (!key.written) return false;
  if (refused(key, object)) return true;
  if (!is_written(key, object)) return false;
  const std::string text = key.written(key, object + key.offset);
  if (text == "[]" && key.standard.empty()) return false;
  return key.always || text != key.standard;
}

std::string Table::lines_text(const Key& key, const std::byte* object, double metre) const {
  std::string lines;
  key.each(object + key.offset, [&](const std::string&, const std::byte* one) {
    std::vector<std::string> values;
    for (const Key& below : key.table->keys_)
      if (key.table->has_text(below, one))
        values.push_back(fmt::format("{} = {}", below.name, value_text(below, one, metre)));
    lines += fmt::format("  {{ {} }},\n", fmt::join(values, ", "));
  });
  return lines.empty() ? "" : fmt::format("{} = [\n{}]\n", key.name, lines);
}

std::string Table::tables_text(const Key& key, const std::byte* object, const std::string& prefix,
                               double metre) const {
  std::string text;
  key.each(object + key.offset, [&](const std::string& name, const std::byte* one) {
    const std::string path = prefix + key.name + (name.empty() ? "" : "." + toml_key(name));
    const std::string body = key.table->text_of(one, path + ".", metre);
    if (body.empty() && key.type == Type::kTable) return;
    const char* heading = key.type == Type::kTables ? "{}[[{}]]{}\n{}" : "{}[{}]{}\n{}";
    text += fmt::format(fmt::runtime(heading), prefix.empty() ? "\n" : "", path,
                        key.table->source_of(one, {}).comment(""), body);
  });
  return text;
}

std::string Table::text_of(const std::byte* object, const std::string& prefix, double metre) const {
  if (metre_) metre = *reinterpret_cast<const double*>(object + *metre_);
  const Source none;
  const Source& source = source_of(object, none);
  std::string text, tables;
  for (const Key& key : keys_) {
    if (key.each && !key.one_line) tables += tables_text(key, object, prefix, metre);
    if (key.one_line) text += lines_text(key, object, metre);
    const std::string comment = source.comment(key.name);
    if (key.each || !key.written || (!has_text(key, object) && comment.empty())) continue;
    const std::string value = value_text(key, object, metre);
    text += fmt::format("{} = {}{}\n", key.name, key.triangle ? in_rows(value) : value, comment);
  }
  return text + tables;
}

void Table::check_ranges(const std::byte* object, const Source& above) const {
  const Source& own = source_of(object, above);
  const Source& source = own.where().empty() ? above : own;
  for (const Key& key : keys_) {
    if (const auto value = refused(key, object))
      source.fail(key.name, fmt::format("found {:g}, expected {}", *value, expectation(key.range)));
    if (key.each)
      key.each(object + key.offset, [&](const std::string&, const std::byte* one) {
        key.table->check_ranges(one, source);
      });
  }
}

}  // namespace clatter::keys
