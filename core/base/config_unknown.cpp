// SPDX-License-Identifier: GPL-3.0-or-later
// Unknown keys, and the key that was probably meant.
#include <fmt/format.h>

#include "core/base/config_impl.hpp"
#include "core/base/error.hpp"
#include "core/base/nearest_name.hpp"

namespace clatter {
namespace {

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
  const std::string close = nearest_name(unknown.key, document_->requested[unknown.table]);
  throw InputError(fmt::format(
      "{}: {}{}: unknown key{}", position_in_file(document_->origin, unknown.node), unknown.prefix,
      unknown.key, close.empty() ? "" : fmt::format(", did you mean {}?", close)));
}

void Config::finish() const { refuse_unknown({&document_->root, ""}); }

void Config::finish_table() const { refuse_unknown(*node_); }

}  // namespace clatter
