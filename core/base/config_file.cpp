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

/// Merges `over` into `base`. Nodes are moved, not copied, to keep file and line.
void overlay(toml::table& base, toml::table& over) {
  for (auto&& [key, value] : over) {
    toml::node* below = base.get(key);
    if (below != nullptr && below->is_table() && value.is_table()) {
      overlay(*below->as_table(), *value.as_table());
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
  overlay(base, table);
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
