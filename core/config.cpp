#include "core/config.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/error.hpp"

namespace clatter {

struct Config::Document {
  toml::table root;
  std::string origin;                        // file name for messages
  std::filesystem::path folder;              // relative paths start here
  std::vector<std::filesystem::path> files;  // that were read
  std::set<const toml::node*> known;         // values and tables that somebody asked for
  std::map<const toml::table*, std::set<std::string>> asked;  // keys asked for, found or not
  std::vector<std::pair<std::string, std::string>> resolved;  // in order of asking
};

struct Config::Node {
  const toml::table* table;
  std::string prefix;  // "contact.film." for messages
};

namespace {

size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row.back();
}

std::string nearest(const std::string& key, const std::set<std::string>& candidates) {
  std::string best;
  size_t best_distance = key.size() / 2 + 2;
  for (const auto& candidate : candidates) {
    const size_t distance = edit_distance(key, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

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

Config::Config(std::shared_ptr<Document> document, std::shared_ptr<Node> node)
    : document_(std::move(document)), node_(std::move(node)) {}

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path)) {
    throw InputError(fmt::format("{}: no such file, expected a TOML file", path.string()));
  }
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

/// Moves what `over` says into `base`. Nodes are moved, not copied: they keep file and line.
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

namespace {

std::string place(const std::string& origin, const toml::node* node) {
  if (node == nullptr || node->source().begin.line == 0) return origin;
  const auto& file = node->source().path;  // a base's values stand in the base's file
  return fmt::format("{}:{}", file ? *file : origin, node->source().begin.line);
}

}  // namespace

std::string Config::where() const { return place(document_->origin, node_->table); }

void Config::fail(std::string_view key, const std::string& message) const {
  const toml::node* at = node_->table->get(key);
  throw InputError(fmt::format("{}: {}{}: {}",
                               place(document_->origin, at != nullptr ? at : node_->table),
                               node_->prefix, key, message));
}

bool Config::has(std::string_view key) const {
  document_->asked[node_->table].insert(std::string(key));
  return node_->table->get(key) != nullptr;
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
  const toml::node* node = node_->table->get(key);
  if (!node->is_table()) fail(key, fmt::format("found {}, expected a table", shown(*node)));
  document_->known.insert(node);
  return Config(document_, std::make_shared<Node>(
                               Node{node->as_table(), fmt::format("{}{}.", node_->prefix, key)}));
}

Config Config::table(std::string_view key) const {
  auto found = find_table(key);
  if (!found) fail(key, fmt::format("found nothing, expected a table [{}{}]", node_->prefix, key));
  return *found;
}

std::vector<Config> Config::tables(std::string_view key) const {
  std::vector<Config> result;
  if (!has(key)) return result;
  const toml::node* node = node_->table->get(key);
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

double Config::number(std::string_view key, Range range) const {
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
  if (!has(key)) fail(key, "found nothing, expected a text in quotes");
  const toml::node* node = node_->table->get(key);
  if (!node->is_string()) {
    fail(key, fmt::format("found {}, expected a text in quotes", shown(*node)));
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
  if (!has(key)) fail(key, "found nothing, expected a list of texts");
  const toml::node* node = node_->table->get(key);
  if (!node->is_array()) fail(key, fmt::format("found {}, expected a list of texts", shown(*node)));
  std::vector<std::string> values;
  for (const auto& element : *node->as_array()) {
    if (!element.is_string()) {
      fail(key, fmt::format("found {} in the list, expected a text in quotes", shown(element)));
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
  const std::filesystem::path named = text(key);
  if (named.is_absolute()) return named;
  const auto& file = node_->table->get(key)->source().path;
  const bool from_base = file && *file != document_->origin;
  return (from_base ? std::filesystem::path(*file).parent_path() : document_->folder) / named;
}

namespace {

/// The first key, in order of the file, that nobody asked for.
struct Unknown {
  const toml::node* node = nullptr;
  const toml::table* table = nullptr;
  std::string key, prefix;
};

using Asked = std::map<const toml::table*, std::set<std::string>>;

void find_unknown(const toml::table& table, const std::string& prefix, const Asked& asked,
                  const std::set<const toml::node*>& known, Unknown& first) {
  const auto at = asked.find(&table);
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    const bool is_known = at != asked.end() && at->second.count(name) != 0;
    if (!is_known) {
      if (first.node == nullptr || value.source().begin < first.node->source().begin) {
        first = {&value, &table, name, prefix};
      }
      continue;
    }
    if (value.is_table() && known.count(&value) != 0) {
      find_unknown(*value.as_table(), prefix + name + ".", asked, known, first);
    } else if (value.is_array_of_tables() && known.count(&value) != 0) {
      size_t index = 0;
      for (const auto& element : *value.as_array()) {
        find_unknown(*element.as_table(), fmt::format("{}{}[{}].", prefix, name, index++), asked,
                     known, first);
      }
    }
  }
}

}  // namespace

void Config::finish() const {
  Unknown unknown;
  find_unknown(document_->root, "", document_->asked, document_->known, unknown);
  if (unknown.node == nullptr) return;
  const std::string close = nearest(unknown.key, document_->asked[unknown.table]);
  throw InputError(fmt::format("{}: {}{}: unknown key{}", place(document_->origin, unknown.node),
                               unknown.prefix, unknown.key,
                               close.empty() ? "" : fmt::format(", did you mean {}?", close)));
}

std::string Config::resolved() const {
  std::string text;
  std::set<std::string> seen;
  for (const auto& [key, value] : document_->resolved) {
    if (seen.insert(key).second) text += fmt::format("{} = {}\n", key, value);
  }
  return text;
}

}  // namespace clatter
