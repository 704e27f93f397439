// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The keys of one TOML table, without the type of the struct that they fill: see keys.hpp.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/keys/key.hpp"
#include "core/keys/source.hpp"

namespace clatter::keys {

/// The condition of a rule as it would be written: law, law = "vogel", law = "vogel" or "walther".
std::string condition(const Key* other, const Rule& rule);

class Table {
 public:
  Table(std::string name, std::string meaning)
      : name_(std::move(name)), meaning_(std::move(meaning)) {}

  const std::string& name() const { return name_; }
  const std::string& meaning() const { return meaning_; }
  const std::vector<Key>& keys() const { return keys_; }
  /// Groups of keys of which exactly one is given.
  const std::vector<std::vector<std::string>>& alternatives() const { return alternatives_; }
  /// nullptr when the table has no key of this name.
  const Key* find(std::string_view name) const;
  /// What the table lacks may come from others: a schema requires nothing of it.
  void complete_elsewhere() { complete_elsewhere_ = true; }
  bool is_complete() const { return !complete_elsewhere_; }
  /// Lists a table that its owner reads, under the name that it has in this one.
  void add(std::string name, Type type, const Table& table);

  /// InputError for an unknown key of the table, with the nearest name.
  void check_known(const Config& table) const;
  /// Reads all keys into the struct at `object`, whose values before are the defaults. InputError
  /// "file:line: key: ..." for an unknown key of the table, with the nearest name; for keys that
  /// exclude or need each other, or lack; and for values outside their range.
  void read(const Config& table, std::byte* object) const;
  /// All values as TOML, that of `prefix` below which the table is; defaults that exclude or need
  /// what the object has otherwise are left out.
  std::string toml_of(const std::byte* object, const std::string& prefix = "") const;
  /// The struct as a file for people: without defaults, with the comments of its sources, lengths
  /// in the file's unit. `prefix` as above.
  std::string text_of(const std::byte* object, const std::string& prefix = "",
                      double metre = 1.0) const;
  /// Refuses numbers outside their range, also of tables below, as read() does.
  void check_ranges(const std::byte* object, const Source& above = {}) const;

 private:
  friend class Rows;
  template <class S>
  friend class Keys;
  void check_rules(const Config& table, const std::byte* object) const;
  bool is_written(const Key& key, const std::byte* object) const;
  bool has_text(const Key& key, const std::byte* object) const;
  /// Its tables below, each with its heading.
  std::string tables_text(const Key& key, const std::byte* object, const std::string& prefix,
                          double metre) const;
  /// The tables of a list in braces, one a line.
  std::string lines_text(const Key& key, const std::byte* object, double metre) const;
  const Source& source_of(const std::byte* object, const Source& other) const;
  bool has_value(const Rule& rule, const std::byte* object) const;
  /// What it needs is there, as far as rows before it say: without that no default is recorded.
  bool applies(const Key& key, const Config& table, const std::byte* object) const;
  bool holds(const Rule& rule, const Config& table, const std::byte* object) const;

  /// The defaults are what the object has, also those of the tables below.
  void write_standards(const std::byte* standard);
  /// Of a copy: no default differs.
  bool has_standards_of(const Table& other) const;

  std::string name_, meaning_;
  std::vector<Key> keys_;
  std::vector<std::vector<std::string>> alternatives_;
  bool complete_elsewhere_ = false;
  std::optional<size_t> source_;  // offset of a Source in the struct
  std::optional<size_t> metre_;   // offset of the file's unit of lengths
  bool shared_ = false;           // other readers take further keys of the same TOML table
};

}  // namespace clatter::keys
