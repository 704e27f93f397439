// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// TOML input by the rules of design.md section 5: an unknown key is an error that names the nearest
// known key; every value used, including defaults, can be printed and stored.
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clatter {

/// Bounds of a number, both ends included unless `open_min`; default: any finite number.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
  static Range not_negative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }
  static Range between(double min, double max) { return {min, max, false}; }
};

/// What a number in a range is called: "a number above 0".
std::string expectation(const Range& range);

/// One table of a TOML file. Reading a key marks it as known; `finish()` on the root refuses all
/// other keys. Every getter throws InputError with "file:line: key: found ..., expected ...".
class Config {
 public:
  /// Reads a file; InputError with line and column when it is missing or not TOML.
  static Config load(const std::filesystem::path& path);
  /// Like load(), but the file may contain `base = "other.toml"`: keys that it does not define are
  /// taken from there, table by table. Arrays are replaced entirely, unless a table [drive.crank]
  /// changes keys of the entry named "crank" of [[drive]] (by index where entries have no name).
  static Config load_with_base(const std::filesystem::path& path);
  /// Reads TOML from memory; `origin` is used as the file name in messages.
  static Config parse(std::string_view text, const std::string& origin);

  /// This table with the keys that it lacks from another table of the same file, sub-tables
  /// likewise; errors and resolved values name the table that has the key.
  Config with_fallback(const Config& below) const;

  bool has(std::string_view key) const;
  /// True when the key exists and its value is a list.
  bool is_list(std::string_view key) const;
  /// Keys of this table in file order; for tables whose keys are user-defined names.
  std::vector<std::string> keys() const;

  /// A sub-table; table() throws when it is absent.
  Config table(std::string_view key) const;
  std::optional<Config> find_table(std::string_view key) const;
  /// An array of tables ([[key]]); empty when absent.
  std::vector<Config> tables(std::string_view key) const;

  double number(std::string_view key, Range range = {}) const;
  double number_or(std::string_view key, double fallback, Range range = {}) const;
  int64_t integer(std::string_view key, Range range = {}) const;
  int64_t integer_or(std::string_view key, int64_t fallback, Range range = {}) const;
  bool flag_or(std::string_view key, bool fallback) const;
  std::string text(std::string_view key) const;
  std::string text_or(std::string_view key, const std::string& fallback) const;
  /// A string that must be one of `allowed`; the first is the default when the key is absent.
  std::string choice(std::string_view key, std::initializer_list<std::string_view> allowed) const;
  std::vector<double> numbers(std::string_view key) const;
  std::vector<double> numbers_or(std::string_view key, const std::vector<double>& fallback) const;
  /// A list of exactly `count` numbers.
  std::vector<double> numbers(std::string_view key, size_t count) const;
  std::vector<std::string> texts(std::string_view key) const;
  std::vector<std::string> texts_or(std::string_view key,
                                    const std::vector<std::string>& fallback) const;
  /// Path of a file to read, relative to the TOML file; InputError when it is also an output.
  std::filesystem::path path(std::string_view key) const;

  /// The unit of lengths that have none in their key's name [m]; 1 until it is set, for all tables
  /// of the file.
  double metre() const;
  void set_metre(double metre) const;

  /// The TOML files read: the file itself, then its bases.
  const std::vector<std::filesystem::path>& files() const;

  /// Refuses every key of the file that was never read. Call after all tables were read.
  void finish() const;
  /// Refuses every key of this table that was never read, before a message that it would explain.
  void finish_table() const;
  /// Every value that was read, defaults included, as TOML-like lines "table.key = value".
  std::string resolved() const;
  /// "file:line: key: message" as an InputError.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// Position of this table for messages: "file:line".
  std::string where() const;
  /// The same with its name: "file:line: bushing[0].a".
  std::string where_named() const;
  /// Position of a key for messages, "file:line: table.key"; of the table when it is absent.
  std::string where(std::string_view key) const;

 private:
  struct Document;
  struct Node;
  Config(std::shared_ptr<Document> document, std::shared_ptr<Node> node);
  void refuse_unknown(const Node& node) const;
  /// The table below from which a key comes that this one lacks; empty: not from there.
  std::optional<Config> fallback_of(std::string_view key) const;
  std::shared_ptr<Document> document_;
  std::shared_ptr<Node> node_;
};

}  // namespace clatter
