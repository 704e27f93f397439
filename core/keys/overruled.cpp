// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/overruled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/base/log.hpp"

namespace clatter::keys {
namespace {

using Overruled = std::map<std::string, std::string>;

/// Number of the file that has a key: 0 of the file itself, then those of its bases.
size_t file_of(const Config& config, const std::string& key) {
  const std::string where = config.where(key);
  size_t found = 0, length = 0;
  for (size_t k = 0; k < config.files().size(); ++k) {
    const std::string name = config.files()[k].string() + ":";
    if (where.starts_with(name) && name.size() > length) found = k, length = name.size();
  }
  return found;
}

bool is_below(const Config& config, const std::string& key, const std::string& other) {
  return file_of(config, key) > file_of(config, other);
}

/// Whether a choice or flag that the file gives lacks the values of a rule.
bool has_other_value(const Key& other, const Rule& rule, const Config& config) {
  if (rule.values.empty() || !config.has(other.name)) return false;
  const auto is = [&](const std::string& value) {
    return std::find(rule.values.begin(), rule.values.end(), value) != rule.values.end();
  };
  if (other.type == Type::kChoice) return !is(config.text(other.name));
  return other.type == Type::kFlag && !is(config.flag_or(other.name, false) ? "true" : "false");
}

/// The key of an upper file that makes `key` meaningless; "" for none.
std::string judge(const Table& table, const Key& key, const Config& config,
                  const Overruled& overruled) {
  for (const Rule& rule : key.rules) {
    const Key* other = table.find(rule.other);
    if (other == nullptr || rule.kind != Rule::Kind::kNeeds) continue;
    const auto gone = overruled.find(rule.other);
    const std::string& by = gone != overruled.end() ? gone->second : rule.other;
    if ((gone != overruled.end() || has_other_value(*other, rule, config)) &&
        is_below(config, key.name, by))
      return by;
  }
  for (const Key& other : table.keys())
    for (const auto& [one, rules] : {std::pair(&other, &key.rules), {&key, &other.rules}})
      for (const Rule& rule : *rules)
        if (rule.kind == Rule::Kind::kExcludes && rule.other == one->name &&
            config.has(other.name) && is_below(config, key.name, other.name))
          return other.name;
  for (const auto& group : table.alternatives())
    if (std::find(group.begin(), group.end(), key.name) != group.end())
      for (const std::string& other : group)
        if (config.has(other) && is_below(config, key.name, other)) return other;
  return "";
}

}  // namespace

Overruled overruled_keys(const Table& table, const Config& config) {
  Overruled overruled;
  if (config.files().size() < 2) return overruled;
  size_t before = 0;
  do {  // what needs an overruled key goes with it
    before = overruled.size();
    for (const Key& key : table.keys())
      if (config.has(key.name) && !overruled.contains(key.name))
        if (const std::string by = judge(table, key, config, overruled); !by.empty())
          overruled[key.name] = by;
  } while (overruled.size() > before);
  return overruled;
}

void report_overruled(const Overruled& overruled, const Config& config) {
  static std::set<std::string> reported;  // several components read the same table
  for (const auto& [key, by] : overruled)
    if (const std::string line = fmt::format("{}: left out, it does not go with {}",
                                             config.where(key), config.where(by));
        reported.insert(line).second)
      warn(line);
}

}  // namespace clatter::keys
