// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>

#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/nearest_name.hpp"

namespace clatter::keys {
namespace {

std::string json_list(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string json_texts(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(json_text(text));
  return json_list(items);
}

const char* name_of(Type type) {
  switch (type) {
    case Type::kNumber:
      return "number";
    case Type::kInteger:
      return "integer";
    case Type::kFlag:
      return "flag";
    case Type::kText:
      return "text";
    case Type::kChoice:
      return "choice";
    case Type::kPath:
      return "path";
    case Type::kNumbers:
      return "numbers";
    case Type::kTexts:
      return "texts";
    case Type::kTable:
      return "table";
    case Type::kTables:
      return "tables";
    case Type::kNamed:
      return "named tables";
    case Type::kEither:
      return "either";
    case Type::kByName:
      return "numbers by name";
  }
  return "";
}

const char* name_of(Rule::Kind kind) {
  switch (kind) {
    case Rule::Kind::kExcludes:
      return "excludes";
    case Rule::Kind::kNeeds:
      return "needs";
    case Rule::Kind::kRequiredWith:
      return "required_with";
    case Rule::Kind::kAsMany:
      return "as_many_as";
  }
  return "";
}

std::string json_of(const Rule& rule) {
  JsonMembers members{{"kind", json_text(name_of(rule.kind))}, {"other", json_text(rule.other)}};
  if (!rule.values.empty()) members.emplace_back("values", json_texts(rule.values));
  if (!rule.reason.empty()) members.emplace_back("reason", json_text(rule.reason));
  return json_object(members);
}

std::string json_of(const Key& key) {
  JsonMembers members{{"name", json_text(key.name)}, {"type", json_text(name_of(key.type))}};
  const auto add = [&](const char* name, const std::string& json) {
    members.emplace_back(name, json);
  };
  if (!key.unit.shown.empty()) add("unit", json_text(key.unit.shown));
  if (std::isfinite(key.range.min))
    add(key.range.open_min ? "above" : "min", json_number(key.range.min));
  if (std::isfinite(key.range.max)) add("max", json_number(key.range.max));
  if (key.count > 0) add("count", fmt::format("{}", key.count));
  if (!key.choices.empty()) add("choices", json_texts(key.choices));
  if (!key.shape.empty()) add("shape", json_text(key.shape));
  if (!key.types.empty()) {
    std::vector<std::string> types;
    for (const Type type : key.types) types.emplace_back(name_of(type));
    add("types", json_texts(types));
  }
  if (!key.standard.empty() && key.standard != "[]") add("default", json_text(key.standard));
  if (key.required) add("required", "true");
  if (key.ascending) add("ascending", "true");
  if (!key.rules.empty()) {
    std::vector<std::string> rules;
    for (const Rule& rule : key.rules) rules.push_back(json_of(rule));
    add("rules", json_list(rules));
  }
  add("meaning", json_text(key.meaning));
  if (key.table != nullptr) add("table", keys::json_of(*key.table));
  return json_object(members);
}

std::string range_text(const Range& range) {
  const bool below = std::isfinite(range.max), above = std::isfinite(range.min);
  std::string text;
  if (above)
    text = fmt::format("{}{:g}",
                       range.open_min ? " above "
                       : below        ? " from "
                                      : " of at least ",
                       range.min);
  if (below) text += fmt::format("{}{:g}", above ? " to " : " of at most ", range.max);
  return text;
}

std::string kind_text(const Key& key) {
  switch (key.type) {
    case Type::kNumber:
      return "number" + range_text(key.range);
    case Type::kInteger:
      return "whole number" + range_text(key.range);
    case Type::kFlag:
      return "true or false";
    case Type::kText:
      return "text";
    case Type::kChoice:
      return fmt::format("\"{}\"", fmt::join(key.choices, "\" | \""));
    case Type::kPath:
      return "path of a file";
    case Type::kNumbers:
      return (key.count > 0 ? fmt::format("list of {} numbers", key.count) : "list of numbers") +
             (range_text(key.range).empty() ? "" : ", each" + range_text(key.range)) +
             (key.ascending ? ", ascending" : "");
    case Type::kTexts:
      return key.choices.empty() ? "list of texts"
                                 : fmt::format("list of \"{}\"", fmt::join(key.choices, "\" | \""));
    case Type::kTable:
      return "table";
    case Type::kTables:
      return "tables, none or more";
    case Type::kNamed:
      return "tables by name";
    case Type::kEither:
      return key.shape + range_text(key.range);
    case Type::kByName:
      return "numbers by name" + range_text(key.range);
  }
  return "";
}

std::string rule_text(const Table& table, const Rule& rule) {
  const std::string other = condition(table.find(rule.other), rule);
  const std::string because = rule.reason.empty() ? "" : " (" + rule.reason + ")";
  switch (rule.kind) {
    case Rule::Kind::kExcludes:
      return "not with " + other + because;
    case Rule::Kind::kNeeds:
      return "only with " + other + because;
    case Rule::Kind::kRequiredWith:
      return "required with " + other + because;
    case Rule::Kind::kAsMany:
      return "as many as " + other;
  }
  return "";
}

/// ", required, only with ..."; a key of one choice that cannot do without it says so once.
std::string rules_text(const Table& table, const Key& key) {
  std::string text = key.required ? ", required" : "";
  for (const Rule& rule : key.rules) {
    const bool is_said = std::any_of(key.rules.begin(), key.rules.end(), [&](const Rule& other) {
      return rule.kind == Rule::Kind::kNeeds && other.kind == Rule::Kind::kRequiredWith &&
             other.other == rule.other && other.values == rule.values;
    });
    const bool is_needed = std::any_of(key.rules.begin(), key.rules.end(), [&](const Rule& other) {
      return rule.kind == Rule::Kind::kRequiredWith && other.kind == Rule::Kind::kNeeds &&
             other.other == rule.other && other.values == rule.values;
    });
    if (!is_said) text += ", " + rule_text(table, rule) + (is_needed ? " only" : "");
  }
  return text;
}

std::string line_of(const Table& table, const Key& key) {
  std::string text = kind_text(key);
  if (!key.standard.empty() && key.standard != "[]") text += ", default " + key.standard;
  const std::string unit = key.unit.shown.empty() ? "" : " [" + key.unit.shown + "]";
  return fmt::format("  {:23} {}{}\n{:28}{}{}\n", key.name, key.meaning, unit, "", text,
                     rules_text(table, key));
}

std::string under(const Table& table, const std::string& heading, const std::string& meaning) {
  std::string text = fmt::format("{}  {}\n", heading, meaning);
  for (const Key& key : table.keys())
    if (key.table == nullptr) text += line_of(table, key);
  for (const auto& group : table.alternatives())
    text += fmt::format("  exactly one of {}\n", fmt::join(group, ", "));
  for (const Key& key : table.keys()) {
    if (key.table == nullptr) continue;
    const char* form = key.type == Type::kTables  ? "[[{}]]"
                       : key.type == Type::kNamed ? "[{}.NAME]"
                                                  : "[{}]";
    const std::string inner =
        heading.front() == '[' ? heading.substr(heading.find_first_not_of('[')) : "";
    const std::string prefix = inner.empty() ? "" : inner.substr(0, inner.find(']')) + ".";
    text += "\n" + under(*key.table, fmt::format(fmt::runtime(form), prefix + key.name),
                         key.meaning + rules_text(table, key));
  }
  return text;
}

/// The nearest name of a key, or all names.
std::string nearest_of(const std::string& name, const Table& table) {
  std::set<std::string> names;
  for (const Key& key : table.keys()) names.insert(key.name);
  const std::string nearest = nearest_name(name, names);
  return nearest.empty() ? fmt::format("{}", fmt::join(names, ", ")) : nearest;
}

/// What a name of the command line means: a file of the program, or a table or key of any.
std::string text_of(const std::vector<const Table*>& files, const std::string& name) {
  std::string text, refused;
  for (const Table* file : files) {
    if (!name.empty() && name != file->name()) try {
        text += text_of(*file, name);
      } catch (const InputError& error) {
        if (refused.empty()) refused = error.what();
      }
    else
      text += text_of(*file);
  }
  if (text.empty()) throw InputError(refused);
  return text;
}

}  // namespace

std::string json_of(const Table& table) {
  std::vector<std::string> rows, groups;
  for (const Key& key : table.keys()) rows.push_back(json_of(key));
  for (const auto& group : table.alternatives()) groups.push_back(json_texts(group));
  JsonMembers members{{"name", json_text(table.name())}, {"meaning", json_text(table.meaning())}};
  if (!groups.empty()) members.emplace_back("one_of", json_list(groups));
  if (!table.is_complete()) members.emplace_back("complete", "false");
  members.emplace_back("keys", json_list(rows));
  return json_object(members);
}

std::string text_of(const Table& table) { return under(table, table.name(), table.meaning()); }

std::string text_of(const Table& table, const std::string& path) {
  if (path.empty()) return text_of(table);
  const size_t dot = path.find('.');
  const std::string name = path.substr(0, dot);
  const Key* key = table.find(name);
  if (key == nullptr)
    throw InputError(fmt::format("{}: no key of {}, did you mean {}?", name, table.name(),
                                 nearest_of(name, table)));
  if (dot != std::string::npos && key->table == nullptr)
    throw InputError(fmt::format("{}: a key, not a table", name));
  if (dot != std::string::npos) return text_of(*key->table, path.substr(dot + 1));
  return key->table != nullptr ? under(*key->table, fmt::format("[{}]", name), key->meaning)
                               : line_of(table, *key);
}

void add_keys_command(CommandLine& program, std::vector<const Table*> files) {
  std::vector<std::string> names;
  for (const Table* file : files) names.push_back(file->name());
  CommandLine& line = program.command(
      "keys", fmt::format("Prints what may be in {}.", fmt::join(names, " and ")),
      "Without a name all of it, with that of a table or key, window or window.taper, that part;\n"
      "--json prints all of it as one line.");
  const auto name = std::make_shared<std::string>();
  line.word("name", *name, "a file, a table, or a key of it: window, window.taper");
  line.action([files, name](const CommonOptions& common) {
    if (!common.json) return std::fputs(text_of(files, *name).c_str(), stdout), void();
    std::vector<std::string> all;
    for (const Table* file : files) all.push_back(json_of(*file));
    print_json({{"files", json_list(all)}});
  });
}

}  // namespace clatter::keys
