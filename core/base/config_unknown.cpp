// SPDX-License-Identifier: GPL-3.0-or-later
// Unknown keys, and the key that was probably meant.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/config_impl.hpp"
#include "core/base/error.hpp"

namespace clatter {
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

/// The first key, in file order, that was never read.
struct Unknown {
  const toml::node* node = nullptr;
  const toml::table* table = nullptr;
  std::string key, prefix;
};

using Requested = std::map<const toml::table*, std::set<std::string>>;

void find_unknown(const toml::table& table, const std::string& prefix, const Requested& requested,
                  const std::set<const toml::node*>& known, Unknown& first) {
  const auto at = requested.find(&table);
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    const bool is_known = at != requested.end() && at->second.count(name) != 0;
    if (!is_known) {
      if (first.node == nullptr || value.source().begin < first.node->source().begin) {
        first = {&value, &table, name, prefix};
      }
      continue;
    }
    if (value.is_table() && known.count(&value) != 0) {
      find_unknown(*value.as_table(), prefix + name + ".", requested, known, first);
    } else if (value.is_array_of_tables() && known.count(&value) != 0) {
      size_t index = 0;
      for (const auto& element : *value.as_array()) {
        find_unknown(*element.as_table(), fmt::format("{}{}[{}].", prefix, name, index++),
                     requested, known, first);
      }
    }
  }
}

}  // namespace

void Config::refuse_unknown(const Node& node) const {
  Unknown unknown;
  find_unknown(*node.table, node.prefix, document_->requested, document_->known, unknown);
  if (unknown.node == nullptr) return;
  const std::string close = nearest(unknown.key, document_->requested[unknown.table]);
  throw InputError(fmt::format(
      "{}: {}{}: unknown key{}", position_in_file(document_->origin, unknown.node), unknown.prefix,
      unknown.key, close.empty() ? "" : fmt::format(", did you mean {}?", close)));
}

void Config::finish() const { refuse_unknown({&document_->root, ""}); }

void Config::finish_table() const { refuse_unknown(*node_); }

}  // namespace clatter
