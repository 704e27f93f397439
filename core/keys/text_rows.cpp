// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of texts, choices and paths.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "core/keys/keys.hpp"
#include "core/keys/member.hpp"

namespace clatter::keys {

Row Rows::text(std::string name, std::string& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kText, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (is_absent(row, table)) return;
    auto& value = member<std::string>(bytes);
    value = row.required ? table.text(row.name) : table.text_or(row.name, value);
  };
  key.written = [](const Key&, const std::byte* bytes) {
    const auto& value = member<std::string>(bytes);
    return value.empty() ? "" : toml_text(value);
  };
  return Row(key);
}

size_t Rows::choice_of(const Key& key, const Config& table, const std::string& text) {
  const auto at = std::find(key.choices.begin(), key.choices.end(), text);
  if (at == key.choices.end())
    table.fail(key.name, fmt::format("found \"{}\", expected one of: {}", text,
                                     fmt::join(key.choices, ", ")));
  return static_cast<size_t>(at - key.choices.begin());
}

Row Rows::add_choice(std::string name, const void* at, std::vector<std::string> choices,
                     std::vector<std::byte> values, std::string meaning) {
  Key& key = add(std::move(name), Type::kChoice, at, std::move(meaning));
  const size_t bytes_each = values.size() / choices.size();
  const auto index_of = [values, bytes_each](const Key& row, const std::byte* bytes) {
    for (size_t k = 0; k < row.choices.size(); ++k)
      if (std::memcmp(bytes, &values[k * bytes_each], bytes_each) == 0) return k;
    return row.choices.size();
  };
  key.choices = std::move(choices);
  key.read = [values, bytes_each, index_of](const Key& row, const Config& table, std::byte* bytes) {
    const size_t standard = index_of(row, bytes);
    if (standard == row.choices.size() && !row.required && !table.has(row.name)) return;
    const std::string text = row.required || standard == row.choices.size()
                                 ? table.text(row.name)
                                 : table.text_or(row.name, row.choices[standard]);
    std::memcpy(bytes, &values[choice_of(row, table, text) * bytes_each], bytes_each);
  };
  key.written = [index_of](const Key& row, const std::byte* bytes) {
    const size_t k = index_of(row, bytes);
    return k == row.choices.size() ? "" : toml_text(row.choices[k]);
  };
  return Row(key);
}

Row Rows::name(std::string name, std::string& at, std::string meaning) {
  Row row = text(std::move(name), at, std::move(meaning));
  Key& key = table_.keys_.back();
  key.read = [read = key.read](const Key& self, const Config& table, std::byte* bytes) {
    read(self, table, bytes);
    const auto& value = member<std::string>(bytes);
    if (table.has(self.name) && (value.empty() || value.find('/') != std::string::npos))
      table.fail(self.name, fmt::format("found \"{}\", expected a name without '/'", value));
  };
  return row;
}

Row Rows::choice(std::string name, std::string& at, std::vector<std::string> choices,
                 std::string meaning) {
  Row row = text(std::move(name), at, std::move(meaning));
  Key& key = table_.keys_.back();
  key.type = Type::kChoice;
  key.choices = std::move(choices);
  key.read = [read = key.read](const Key& self, const Config& table, std::byte* bytes) {
    read(self, table, bytes);
    if (table.has(self.name)) choice_of(self, table, member<std::string>(bytes));
  };
  return row;
}

Row Rows::units(std::string name, UnitSystem& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kChoice, &at, std::move(meaning));
  key.choices = unit_system_names();
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (row.required || table.has(row.name))
      member<UnitSystem>(bytes) = unit_system_named(table.text(row.name), table.where(row.name));
  };
  key.written = [](const Key&, const std::byte* bytes) {
    return toml_text(member<UnitSystem>(bytes).name);
  };
  return Row(key);
}

Row Rows::path(std::string name, std::filesystem::path& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kPath, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (row.required || table.has(row.name))
      member<std::filesystem::path>(bytes) = table.path(row.name);
  };
  key.written = [](const Key&, const std::byte* bytes) {
    const auto& value = member<std::filesystem::path>(bytes);
    return value.empty() ? "" : toml_text(value.string());
  };
  return Row(key);
}

Row Rows::texts(std::string name, std::vector<std::string>& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kTexts, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& values = member<std::vector<std::string>>(bytes);
    values = row.required ? table.texts(row.name) : read_choices(row, table, values);
    if (row.required && values.empty())
      table.fail(row.name, "found none, expected one or more names");
  };
  key.written = [](const Key&, const std::byte* bytes) {
    return in_toml(member<std::vector<std::string>>(bytes));
  };
  return Row(key);
}

std::vector<std::string> Rows::read_choices(const Key& row, const Config& table,
                                            const std::vector<std::string>& standard) {
  const std::vector<std::string> texts = table.texts_or(row.name, standard);
  if (row.choices.empty()) return texts;
  if (texts.empty()) table.fail(row.name, "found none, expected at least one");
  for (const std::string& text : texts)
    if (std::find(row.choices.begin(), row.choices.end(), text) == row.choices.end())
      table.fail(row.name, fmt::format("found \"{}\", expected some of: {}", text,
                                       fmt::join(row.choices, ", ")));
  return texts;
}

std::string Rows::in_toml(const std::vector<std::string>& texts) {
  std::vector<std::string> all;
  for (const std::string& text : texts) all.push_back(toml_text(text));
  return fmt::format("[{}]", fmt::join(all, ", "));
}

void Rows::check_distinct(const Table& keys, const std::vector<Config>& tables) {
  for (const Key& key : keys.keys()) {
    std::set<std::string> texts;
    for (const Config& table : tables)
      if (key.distinct && table.has(key.name) && !texts.insert(table.text(key.name)).second)
        table.fail(key.name, fmt::format("found \"{}\" twice, expected different names",
                                         table.text(key.name)));
  }
}

Row Rows::length_unit(std::string name, double& at,
                      std::vector<std::pair<std::string, double>> units, std::string meaning) {
  std::vector<std::string> names;
  std::vector<std::byte> values;
  for (const auto& [text, metre] : units) {
    names.push_back(text);
    const auto* bytes = reinterpret_cast<const std::byte*>(&metre);
    values.insert(values.end(), bytes, bytes + sizeof(double));
  }
  Row row =
      add_choice(std::move(name), &at, std::move(names), std::move(values), std::move(meaning));
  Key& key = table_.keys_.back();
  table_.metre_ = key.offset;
  key.read = [read = key.read](const Key& self, const Config& table, std::byte* bytes) {
    read(self, table, bytes);
    table.set_metre(member<double>(bytes));
  };
  return row;
}

}  // namespace clatter::keys
