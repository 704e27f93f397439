// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace clatter::keys {
namespace {

std::string because(const std::string& reason) { return reason.empty() ? "" : ": " + reason; }

std::string in_toml(const Key* key, const std::string& value) {
  return key != nullptr && key->type == Type::kChoice ? "\"" + value + "\"" : value;
}

}  // namespace

std::string condition(const Key* other, const Rule& rule) {
  return rule.value.empty() ? rule.other
                            : fmt::format("{} = {}", rule.other, in_toml(other, rule.value));
}

const Key* Table::find(std::string_view name) const {
  const auto at =
      std::find_if(keys_.begin(), keys_.end(), [&](const Key& key) { return key.name == name; });
  return at == keys_.end() ? nullptr : &*at;
}

bool Table::holds(const Rule& rule, const Config& table, const std::byte* object) const {
  if (rule.value.empty()) return table.has(rule.other);
  const Key* other = find(rule.other);
  return other != nullptr && other->written &&
         other->written(*other, object + other->offset) == in_toml(other, rule.value);
}

void Table::check_rules(const Config& table, const std::byte* object) const {
  for (const Key& key : keys_) {
    for (const Rule& rule : key.rules) {
      const bool given = table.has(key.name), is_so = holds(rule, table, object);
      const std::string other = condition(find(rule.other), rule);
      if (rule.kind == Rule::Kind::kExcludes && given && is_so)
        table.fail(key.name, fmt::format("{} and {} exclude each other{}", key.name, other,
                                         because(rule.reason)));
      if (rule.kind == Rule::Kind::kNeeds && given && !is_so)
        table.fail(key.name, fmt::format("needs {}{}", other, because(rule.reason)));
      if (rule.kind == Rule::Kind::kRequiredWith && !given && is_so)
        table.fail(key.name, fmt::format("is missing, {} needs it{}", other, because(rule.reason)));
    }
  }
  for (const std::vector<std::string>& group : alternatives_) {
    std::vector<std::string> given;
    for (const std::string& name : group)
      if (table.has(name)) given.push_back(name);
    if (given.empty()) table.fail(group.front(), fmt::format("give {}", fmt::join(group, " or ")));
    if (given.size() > 1)
      table.fail(given[1], fmt::format("{} exclude each other", fmt::join(given, " and ")));
  }
}

void Table::read(const Config& table, std::byte* object) const {
  for (const Key& key : keys_) table.has(key.name);
  if (!shared_) table.finish_table();
  for (const Key& key : keys_) key.read(key, table, object + key.offset);
  check_rules(table, object);
}

void Table::write_standards(const std::byte* standard) {
  for (Key& key : keys_)
    if (key.written) key.standard = key.required ? "" : key.written(key, standard + key.offset);
}

}  // namespace clatter::keys
