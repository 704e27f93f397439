// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/keys/overruled.hpp"

namespace clatter::keys {
namespace {

std::string because(const std::string& reason) { return reason.empty() ? "" : ": " + reason; }

size_t length_of(const Config& table, const Key& list) {
  if (!table.has(list.name)) return 0;
  return list.type == Type::kTexts ? table.texts(list.name).size()
                                   : table.numbers(list.name).size();
}

bool is_empty_list(const Config& table, const Key& key) {
  return (key.type == Type::kNumbers || key.type == Type::kTexts) && length_of(table, key) == 0;
}

std::string in_toml(const Key* key, const std::string& value) {
  return key != nullptr && key->type == Type::kChoice ? "\"" + value + "\"" : value;
}

}  // namespace

std::string condition(const Key* other, const Rule& rule) {
  if (rule.values.empty()) return rule.other;
  std::vector<std::string> values;
  for (const std::string& value : rule.values) values.push_back(in_toml(other, value));
  return fmt::format("{} = {}", rule.other, fmt::join(values, " or "));
}

bool Key::has_standard() const {
  return !required && std::none_of(rules.begin(), rules.end(), [](const Rule& rule) {
    return rule.kind == Rule::Kind::kRequiredWith;
  });
}

const Key* Table::find(std::string_view name) const {
  const auto at =
      std::find_if(keys_.begin(), keys_.end(), [&](const Key& key) { return key.name == name; });
  return at == keys_.end() ? nullptr : &*at;
}

bool Table::has_value(const Rule& rule, const std::byte* object) const {
  const Key* other = find(rule.other);
  if (other == nullptr || !other->written) return false;
  const std::string found = other->written(*other, object + other->offset);
  return rule.values.empty()
             ? !found.empty() && found != "[]"
             : std::any_of(rule.values.begin(), rule.values.end(), [&](const std::string& value) {
                 return found == in_toml(other, value);
               });
}

bool Table::holds(const Rule& rule, const Config& table, const std::byte* object) const {
  return rule.values.empty() ? table.has(rule.other) : has_value(rule, object);
}

bool Table::applies(const Key& key, const Config& table, const std::byte* object) const {
  return std::all_of(key.rules.begin(), key.rules.end(), [&](const Rule& rule) {
    return rule.kind != Rule::Kind::kNeeds || holds(rule, table, object);
  });
}

void Table::check_rules(const Config& table, const std::byte* object) const {
  const auto overruled = overruled_keys(*this, table);
  const auto has = [&](const std::string& name) {
    return table.has(name) && !overruled.contains(name);
  };
  for (const std::vector<std::string>& group : alternatives_) {
    std::vector<std::string> given;
    for (const std::string& name : group)
      if (has(name)) given.push_back(name);
    if (given.empty()) table.fail(group.front(), fmt::format("give {}", fmt::join(group, " or ")));
    if (given.size() > 1)
      table.fail(given[1], fmt::format("{} exclude each other", fmt::join(given, " and ")));
  }
  for (const Key& key : keys_) {
    for (const Rule& rule : key.rules) {
      const bool given = has(key.name);
      const bool is_so = rule.values.empty() ? has(rule.other) : has_value(rule, object);
      const std::string other = condition(find(rule.other), rule);
      if (rule.kind == Rule::Kind::kExcludes && given && is_so)
        table.fail(key.name, fmt::format("{} and {} exclude each other{}", key.name, other,
                                         because(rule.reason)));
      if (rule.kind == Rule::Kind::kNeeds && given && !is_so)
        table.fail(key.name, fmt::format("needs {}{}", other, because(rule.reason)));
      const bool lacks = !given || is_empty_list(table, key);
      if (rule.kind == Rule::Kind::kRequiredWith && lacks && is_so)
        table.fail(key.name, fmt::format("is missing, {} needs it{}", other, because(rule.reason)));
      if (rule.kind == Rule::Kind::kAsMany && given) {
        const size_t found = length_of(table, key), wanted = length_of(table, *find(rule.other));
        if (found != wanted)
          table.fail(key.name, fmt::format("found {} values, expected as many as {}, {}", found,
                                           rule.other, wanted));
      }
    }
  }
}

void Table::add(std::string name, Type type, const Table& table) {
  Key& key = keys_.emplace_back();
  key.name = std::move(name);
  key.type = type;
  key.meaning = table.meaning();
  key.table = &table;
}

void Table::check_known(const Config& table) const {
  for (const Key& key : keys_) table.has(key.name);
  table.finish_table();
}

void Table::read(const Config& table, std::byte* object) const {
  if (source_) *reinterpret_cast<Source*>(object + *source_) = Source(table);
  if (!shared_) check_known(table);
  const auto overruled = overruled_keys(*this, table);
  report_overruled(overruled, table);
  for (const Key& key : keys_)
    if (key.read && !overruled.contains(key.name) &&
        (key.required || table.has(key.name) || applies(key, table, object)))
      key.read(key, table, object + key.offset);
  check_rules(table, object);
}

bool Table::is_written(const Key& key, const std::byte* object) const {
  const auto text_of = [&](const Key* one) {
    return one != nullptr && one->written ? one->written(*one, object + one->offset) : "";
  };
  const std::string text = text_of(&key);
  if (text.empty() || (text == "[]" && text == key.standard)) return false;
  const bool is_standard = text == key.standard;
  const auto excludes = [&](const Key& one, const std::string& other) {
    return std::any_of(one.rules.begin(), one.rules.end(), [&](const Rule& rule) {
      return rule.kind == Rule::Kind::kExcludes && rule.other == other;
    });
  };
  for (const Key& other : keys_)
    if (is_standard && (excludes(key, other.name) || excludes(other, key.name)) &&
        text_of(&other) != other.standard)
      return false;
  return std::all_of(key.rules.begin(), key.rules.end(), [&](const Rule& rule) {
    return rule.kind != Rule::Kind::kNeeds || has_value(rule, object);
  });
}

std::string Table::toml_of(const std::byte* object, const std::string& prefix) const {
  std::string text;
  for (const Key& key : keys_)
    if (is_written(key, object))
      text += fmt::format("{} = {}\n", key.name, key.written(key, object + key.offset));
  for (const Key& key : keys_) {
    if (!key.each) continue;
    const char* heading = key.type == Type::kTables ? "[[{}{}{}]]\n" : "[{}{}{}]\n";
    key.each(object + key.offset, [&](const std::string& name, const std::byte* one) {
      const std::string dotted = name.empty() ? "" : "." + name;
      text += fmt::format(fmt::runtime(heading), prefix, key.name, dotted) +
              key.table->toml_of(one, fmt::format("{}{}{}.", prefix, key.name, dotted));
    });
  }
  return text;
}

void Table::write_standards(const std::byte* standard) {
  // One of a group: without it another one holds, and no default.
  const auto is_alternative = [&](const Key& key) {
    return std::any_of(alternatives_.begin(), alternatives_.end(), [&](const auto& group) {
      return std::find(group.begin(), group.end(), key.name) != group.end();
    });
  };
  for (Key& key : keys_)
    if (key.written)
      key.standard =
          key.has_standard() && !is_alternative(key) ? key.written(key, standard + key.offset) : "";
  for (Key& key : keys_)
    if (key.type == Type::kTable && key.each)
      key.each(standard + key.offset, [&key](const std::string&, const std::byte* member) {
        auto own = std::make_shared<Table>(*key.table);
        own->write_standards(member);
        if (own->has_standards_of(*key.table)) return;
        key.own = own;
        key.table = own.get();
      });
}

bool Table::has_standards_of(const Table& other) const {
  return std::equal(keys_.begin(), keys_.end(), other.keys_.begin(), other.keys_.end(),
                    [](const Key& a, const Key& b) {
                      return a.standard == b.standard &&
                             (a.type != Type::kTable || a.table->has_standards_of(*b.table));
                    });
}

}  // namespace clatter::keys
