// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What is known of one key of a TOML table, as data: readers, --help, the pages docs/keys and the
// schemas for editors all come from it.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "core/keys/key_units.hpp"

namespace clatter::keys {

class Table;

enum class Type {
  kNumber,
  kInteger,
  kFlag,     // true or false
  kText,     // any text
  kChoice,   // one of the texts `choices`
  kPath,     // of a file to read, relative to the TOML file
  kNumbers,  // a list
  kTexts,    // a list
  kTable,    // a table of its own
  kTables,   // [[tables]]
  kNamed,    // a table whose keys are names, each with a table
  kEither,   // several of them, `types`: `shape` says it in words
  kByName,   // a table whose keys are names, each with a number
};

/// When a key may or must be given, by another key of its table.
struct Rule {
  enum class Kind {
    kExcludes,      // not together with `other`
    kNeeds,         // only together with `other`, or where it has one of the values
    kRequiredWith,  // must be there where `other` is, or where it has one of the values
    kAsMany,        // a list as long as the list `other`
  };
  Kind kind;
  std::string other;
  std::vector<std::string> values;  // of a choice, "true" or "false"; none: whatever it is
  std::string reason;               // completes the message; may be empty
};

struct Key {
  std::string name;
  Type type = Type::kNumber;
  std::string meaning;  // one sentence without a full stop
  KeyUnit unit;         // of numbers
  Range range;          // of numbers, in the key's unit
  size_t count = 0;     // of lists: exactly so many; 0: any
  std::vector<std::string> choices;
  std::vector<Type> types;  // of kEither
  std::string shape;        // of kEither, as the reference prints it
  bool distinct = false;    // of a text: no other table of the list has the same
  std::string standard;     // the default as TOML; "": none
  bool required = false;
  bool ascending = false;  // of lists of numbers
  bool always = false;     // a text for people has it also where it is the default
  bool one_line = false;   // of kTables: a text has each on a line, in braces
  bool triangle = false;   // of kNumbers: a text has the rows of a lower triangle
  std::vector<Rule> rules;
  const Table* table = nullptr;  // of kTable, kTables and kNamed
  std::shared_ptr<const Table>
      own;  // that table, where the member has other defaults than its struct

  /// Without it the struct's value holds; not where a rule may require the key.
  bool has_standard() const;

  size_t offset = 0;  // of the member in the struct
  /// Sets the member at `member` where `table` has the key.
  std::function<void(const Key& key, const Config& table, std::byte* member)> read;
  /// The member as TOML; "" for what no file can give. Empty for tables.
  std::function<std::string(const Key& key, const std::byte* member)> written;
  /// The first number outside the range, in the key's unit. Empty for keys without numbers.
  std::function<std::optional<double>(const Key& key, const std::byte* member)> outside;
  /// Calls see(name, struct) for each struct of a kTable, kTables or kNamed; the name of kNamed.
  using See = std::function<void(const std::string& name, const std::byte* object)>;
  std::function<void(const std::byte* member, const See& see)> each;
};

}  // namespace clatter::keys
