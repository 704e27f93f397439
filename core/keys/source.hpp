// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where a struct of a table comes from, for messages and for the comments of its text.
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/config.hpp"

namespace clatter::keys {

/// A TOML table, or another origin such as a line of a deck, with remarks for people.
class Source {
 public:
  Source() = default;
  explicit Source(const Config& table) : table_(table) {}
  explicit Source(std::string where) : where_(std::move(where)) {}

  /// "file:line"; empty: unknown.
  std::string where() const { return table_ ? table_->where() : where_; }
  /// InputError "file:line: load[0].key: message".
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// The same for a table below, for messages of its keys.
  Source below(std::string_view key) const;

  /// A comment behind a key of the written text, or with "" behind the table's heading.
  Source& remark(const std::string& key, std::string text) {
    remarks_[key] = std::move(text);
    return *this;
  }
  /// "  # text", or nothing; of a heading without a remark its origin outside of a TOML file.
  std::string comment(const std::string& key) const;

 private:
  std::optional<Config> table_;
  std::string where_;
  std::map<std::string, std::string> remarks_;
};

}  // namespace clatter::keys
