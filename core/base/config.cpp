// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a configuration, each checked and recorded; errors give its position.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "core/base/config_impl.hpp"
#include "core/base/error.hpp"
#include "core/base/planned_files.hpp"

namespace clatter {
namespace {

std::string shown(const toml::node& node) {
  std::ostringstream stream;
  node.visit([&](const auto& concrete) {
    if constexpr (toml::is_table<decltype(concrete)>) {
      stream << "a table";
    } else if constexpr (toml::is_array<decltype(concrete)>) {
      stream << "an array";
    } else {
      stream << concrete;
    }
  });
  return stream.str();
}

bool inside(double value, const Range& range) {
  return std::isfinite(value) && value <= range.max &&
         (range.open_min ? value > range.min : value >= range.min);
}

std::string joined(const std::vector<double>& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string joined(const std::vector<std::string>& values) {
  std::vector<std::string> quoted;
  for (const auto& value : values) quoted.push_back("\"" + value + "\"");
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

}  // namespace

std::string expectation(const Range& range) {
  const bool below = std::isfinite(range.max);
  const bool above = std::isfinite(range.min);
  const char* lower = range.open_min ? "above" : "at least";
  if (above && below)
    return fmt::format("a number {} {} and at most {}", lower, range.min, range.max);
  if (above) return fmt::format("a number {} {}", lower, range.min);
  if (below) return fmt::format("a number of at most {}", range.max);
  return "a finite number";
}

Config::Config(std::shared_ptr<Document> document, std::shared_ptr<Node> node)
    : document_(std::move(document)), node_(std::move(node)) {}

std::string Config::where() const { return position_in_file(document_->origin, node_->table); }

std::string Config::where_named() const {
  return where() + ": " + node_->prefix.substr(0, node_->prefix.size() - 1);
}

std::string Config::where(std::string_view key) const {
  if (const auto below = fallback_of(key)) return below->where(key);
  const toml::node* at = node_->table->get(key);
  return fmt::format("{}: {}{}",
                     position_in_file(document_->origin, at != nullptr ? at : node_->table),
                     node_->prefix, key);
}

void Config::fail(std::string_view key, const std::string& message) const {
  throw InputError(fmt::format("{}: {}", where(key), message));
}

Config Config::with_fallback(const Config& below) const {
  const auto node = std::make_shared<Node>(*node_);
  node->below = below.node_;
  return Config(document_, node);
}

std::optional<Config> Config::fallback_of(std::string_view key) const {
  if (node_->below == nullptr || node_->table->get(key) != nullptr) return std::nullopt;
  document_->requested[node_->table].insert(std::string(key));
  Config below(document_, node_->below);
  if (!below.has(key)) return std::nullopt;
  return below;
}

bool Config::has(std::string_view key) const {
  document_->requested[node_->table].insert(std::string(key));
  const bool below = node_->below != nullptr && Config(document_, node_->below).has(key);
  return below || node_->table->get(key) != nullptr;
}

std::vector<std::string> Config::keys() const {
  std::vector<std::pair<toml::source_position, std::string>> ordered;
  for (const auto& [key, value] : *node_->table) {
    ordered.emplace_back(value.source().begin, std::string(key.str()));
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& entry : ordered) names.push_back(std::move(entry.second));
  return names;
}

std::optional<Config> Config::find_table(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  std::optional<Config> below;
  if (node_->below != nullptr) below = Config(document_, node_->below).find_table(key);
  const toml::node* node = node_->table->get(key);
  if (node == nullptr) return below;
  if (!node->is_table()) fail(key, fmt::format("found {}, expected a table", shown(*node)));
  document_->known.insert(node);
  const Config table(document_, std::make_shared<Node>(Node{
                                    node->as_table(), fmt::format("{}{}.", node_->prefix, key)}));
  return below ? table.with_fallback(*below) : table;
}

Config Config::table(std::string_view key) const {
  auto found = find_table(key);
  if (!found) fail(key, fmt::format("found nothing, expected a table [{}{}]", node_->prefix, key));
  return *found;
}

std::vector<Config> Config::tables(std::string_view key) const {
  if (const auto below = fallback_of(key)) return below->tables(key);
  std::vector<Config> result;
  if (!has(key)) return result;
  const toml::node* node = node_->table->get(key);
  if (const toml::array* list = node->as_array(); list != nullptr && list->empty()) return result;
  if (!node->is_array_of_tables()) {
    fail(key, fmt::format("found {}, expected tables [[{}{}]]", shown(*node), node_->prefix, key));
  }
  document_->known.insert(node);
  for (const auto& element : *node->as_array()) {
    document_->known.insert(&element);
    const auto prefix = fmt::format("{}{}[{}].", node_->prefix, key, result.size());
    result.push_back(Config(document_, std::make_shared<Node>(Node{element.as_table(), prefix})));
  }
  return result;
}

bool Config::is_list(std::string_view key) const {
  if (const auto below = fallback_of(key)) return below->is_list(key);
  return has(key) && node_->table->get(key)->is_array();
}

double Config::number(std::string_view key, Range range) const {
  if (const auto below = fallback_of(key)) return below->number(key, range);
  if (!has(key)) fail(key, "found nothing, expected " + expectation(range));
  const toml::node* node = node_->table->get(key);
  const auto value = node->value<double>();
  if (!value || node->is_string() || node->is_boolean() || !inside(*value, range)) {
    fail(key, fmt::format("found {}, expected {}", shown(*node), expectation(range)));
  }
  document_->known.insert(node);
  document_->resolved.emplace_back(node_->prefix + std::string(key), fmt::format("{}", *value));
  return *value;
}

double Config::number_or(std::string_view key, double fallback, Range range) const {
  if (has(key)) return number(key, range);
  document_->resolved.emplace_back(node_->prefix + std::string(key), fmt::format("{}", fallback));
  return fallback;
}

int64_t Config::integer(std::string_view key, Range range) const {
  if (const auto below = fallback_of(key)) return below->integer(key, range);
  if (!has(key)) fail(key, "found nothing, expected a whole number");
  const toml::node* node = node_->table->get(key);
  if (!node->is_integer() || !inside(static_cast<double>(*node->value<int64_t>()), range)) {
    fail(key,
         fmt::format("found {}, expected a whole number, {}", shown(*node), expectation(range)));
  }
  document_->known.insert(node);
  const int64_t value = *node->value<int64_t>();
  document_->resolved.emplace_back(node_->prefix + std::string(key), fmt::format("{}", value));
  return value;
}

int64_t Config::integer_or(std::string_view key, int64_t fallback, Range range) const {
  if (has(key)) return integer(key, range);
  document_->resolved.emplace_back(node_->prefix + std::string(key), fmt::format("{}", fallback));
  return fallback;
}

bool Config::flag_or(std::string_view key, bool fallback) const {
  if (const auto below = fallback_of(key)) return below->flag_or(key, fallback);
  bool value = fallback;
  if (has(key)) {
    const toml::node* node = node_->table->get(key);
    if (!node->is_boolean()) {
      fail(key, fmt::format("found {}, expected true or false", shown(*node)));
    }
    document_->known.insert(node);
    value = *node->value<bool>();
  }
  document_->resolved.emplace_back(node_->prefix + std::string(key), value ? "true" : "false");
  return value;
}

std::string Config::text(std::string_view key) const {
  if (const auto below = fallback_of(key)) return below->text(key);
  if (!has(key)) fail(key, "found nothing, expected a string in quotes");
  const toml::node* node = node_->table->get(key);
  if (!node->is_string()) {
    fail(key, fmt::format("found {}, expected a string in quotes", shown(*node)));
  }
  document_->known.insert(node);
  const std::string value = *node->value<std::string>();
  document_->resolved.emplace_back(node_->prefix + std::string(key), "\"" + value + "\"");
  return value;
}

std::string Config::text_or(std::string_view key, const std::string& fallback) const {
  if (has(key)) return text(key);
  document_->resolved.emplace_back(node_->prefix + std::string(key), "\"" + fallback + "\"");
  return fallback;
}

std::string Config::choice(std::string_view key,
                           std::initializer_list<std::string_view> allowed) const {
  const std::string value = text_or(key, std::string(*allowed.begin()));
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    fail(key, fmt::format("found \"{}\", expected one of: {}", value, fmt::join(allowed, ", ")));
  }
  return value;
}

std::vector<double> Config::numbers(std::string_view key) const {
  if (const auto below = fallback_of(key)) return below->numbers(key);
  if (!has(key)) fail(key, "found nothing, expected a list of numbers");
  const toml::node* node = node_->table->get(key);
  if (!node->is_array())
    fail(key, fmt::format("found {}, expected a list of numbers", shown(*node)));
  std::vector<double> values;
  for (const auto& element : *node->as_array()) {
    const auto value = element.value<double>();
    if (!value || !element.is_number() || !std::isfinite(*value)) {
      fail(key, fmt::format("found {} in the list, expected a finite number", shown(element)));
    }
    values.push_back(*value);
  }
  document_->known.insert(node);
  document_->resolved.emplace_back(node_->prefix + std::string(key), joined(values));
  return values;
}

std::vector<double> Config::numbers_or(std::string_view key,
                                       const std::vector<double>& fallback) const {
  if (has(key)) return numbers(key);
  document_->resolved.emplace_back(node_->prefix + std::string(key), joined(fallback));
  return fallback;
}

std::vector<double> Config::numbers(std::string_view key, size_t count) const {
  auto values = numbers(key);
  if (values.size() != count) {
    fail(key, fmt::format("found {} numbers, expected {}", values.size(), count));
  }
  return values;
}

std::vector<std::string> Config::texts(std::string_view key) const {
  if (const auto below = fallback_of(key)) return below->texts(key);
  if (!has(key)) fail(key, "found nothing, expected a list of strings");
  const toml::node* node = node_->table->get(key);
  if (!node->is_array())
    fail(key, fmt::format("found {}, expected a list of strings", shown(*node)));
  std::vector<std::string> values;
  for (const auto& element : *node->as_array()) {
    if (!element.is_string()) {
      fail(key, fmt::format("found {} in the list, expected a string in quotes", shown(element)));
    }
    values.push_back(*element.value<std::string>());
  }
  document_->known.insert(node);
  document_->resolved.emplace_back(node_->prefix + std::string(key), joined(values));
  return values;
}

std::vector<std::string> Config::texts_or(std::string_view key,
                                          const std::vector<std::string>& fallback) const {
  if (has(key)) return texts(key);
  document_->resolved.emplace_back(node_->prefix + std::string(key), joined(fallback));
  return fallback;
}

std::filesystem::path Config::path(std::string_view key) const {
  if (const auto below = fallback_of(key)) return below->path(key);
  std::filesystem::path named = text(key);
  const toml::node* node = node_->table->get(key);
  if (named.is_relative()) {
    const auto& file = node->source().path;
    const bool from_base = file && *file != document_->origin;
    named = (from_base ? std::filesystem::path(*file).parent_path() : document_->folder) / named;
  }
  will_read(named, fmt::format("{}: {}", position_in_file(document_->origin, node), key));
  return named;
}

double Config::metre() const { return document_->metre; }

void Config::set_metre(double metre) const { document_->metre = metre; }

std::string Config::resolved() const {
  std::string text;
  std::set<std::string> seen;
  for (const auto& [key, value] : document_->resolved) {
    if (seen.insert(key).second) text += fmt::format("{} = {}\n", key, value);
  }
  return text;
}

}  // namespace clatter
