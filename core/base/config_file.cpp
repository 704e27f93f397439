// SPDX-License-Identifier: GPL-3.0-or-later
// Sources of a configuration: a file, a file with its bases, a string.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/base/config_impl.hpp"
#include "core/base/error.hpp"
#include "core/base/planned_files.hpp"

namespace clatter {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path)) {
    throw InputError(fmt::format("{}: no such file, expected a TOML file", path.string()));
  }
  will_read(path);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

toml::table parsed(std::string_view text, const std::string& origin) {
  try {
    return toml::parse(text, std::string_view(origin));
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}:{}: not TOML: {}", origin, error.source().begin.line,
                                 error.source().begin.column, error.description()));
  }
}

void overlay(toml::table& base, toml::table& over, const std::string& prefix);

/// The entry of an array of tables that has this name, or, where entries have none, this index.
toml::table* entry_of(toml::array& entries, std::string_view key) {
  size_t index = 0;
  for (toml::node& entry : entries) {
    toml::table& table = *entry.as_table();
    if (table.contains("name") ? table["name"].value<std::string_view>() == key
                               : fmt::format("{}", index) == key)
      return &table;
    ++index;
  }
  return nullptr;
}

/// Changes entries of an array of tables. InputError for one that it does not have.
void change_entries(toml::array& entries, toml::table& changes, const std::string& prefix) {
  for (auto&& [key, value] : changes) {
    const std::string place =
        fmt::format("{}: {}{}", position_in_file("", &value), prefix, std::string_view(key.str()));
    if (!value.is_table())
      throw InputError(place +
                       ": found a value, expected the keys to change of the entry of this "
                       "name, or [[tables]] instead of those of the base");
    toml::table* entry = entry_of(entries, key.str());
    if (entry == nullptr) throw InputError(place + ": the base has no entry of this name");
    overlay(*entry, *value.as_table(), fmt::format("{}{}.", prefix, std::string_view(key.str())));
  }
}

/// Merges `over` into `base`. Nodes are moved, not copied, to keep file and line.
void overlay(toml::table& base, toml::table& over, const std::string& prefix) {
  for (auto&& entry : over) {
    const toml::key& key = entry.first;
    toml::node& value = entry.second;
    toml::node* below = base.get(key);
    const auto inner = fmt::format("{}{}.", prefix, std::string_view(key.str()));
    if (below != nullptr && below->is_table() && value.is_table()) {
      overlay(*below->as_table(), *value.as_table(), inner);
    } else if (below != nullptr && below->is_array_of_tables() && value.is_table()) {
      change_entries(*below->as_array(), *value.as_table(), inner);
    } else {
      value.visit([&](auto& concrete) { base.insert_or_assign(key, std::move(concrete)); });
    }
  }
}

toml::table with_base(const std::filesystem::path& path,
                      std::vector<std::filesystem::path>& files) {
  if (std::find(files.begin(), files.end(), path) != files.end()) {
    throw InputError(fmt::format("{}: base: the file is its own base", path.string()));
  }
  files.push_back(path);
  toml::table table = parsed(text_of(path), path.string());
  const toml::node* named = table.get("base");
  if (named == nullptr) return table;
  if (!named->is_string()) {
    throw InputError(fmt::format("{}:{}: base: expected the path of a TOML file in quotes",
                                 path.string(), named->source().begin.line));
  }
  const std::filesystem::path below = *named->value<std::string>();
  table.erase("base");
  toml::table base = with_base((path.parent_path() / below).lexically_normal(), files);
  overlay(base, table, "");
  return base;
}

}  // namespace

Config Config::load(const std::filesystem::path& path) {
  Config config = parse(text_of(path), path.string());
  config.document_->folder = path.parent_path();
  config.document_->files = {path};
  return config;
}

Config Config::load_with_base(const std::filesystem::path& path) {
  auto document = std::make_shared<Document>();
  document->root = with_base(path, document->files);
  document->origin = path.string();
  document->folder = path.parent_path();
  auto node = std::make_shared<Node>(Node{&document->root, ""});
  return Config(document, node);
}

Config Config::parse(std::string_view text, const std::string& origin) {
  auto document = std::make_shared<Document>();
  document->origin = origin;
  document->root = parsed(text, origin);
  auto node = std::make_shared<Node>(Node{&document->root, ""});
  return Config(document, node);
}

const std::vector<std::filesystem::path>& Config::files() const { return document_->files; }

std::string position_in_file(const std::string& origin, const toml::node* node) {
  if (node == nullptr || node->source().begin.line == 0) return origin;
  const auto& file = node->source().path;  // values of a base refer to the base's file
  return fmt::format("{}:{}", file ? *file : origin, node->source().begin.line);
}

}  // namespace clatter
