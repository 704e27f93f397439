// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Keys as data: one row a key fills one member of a struct.
//
//   struct Spring { double rate = 0.0; double length = 0.1; bool is_guided = false; };  // SI
//
//   const Keys<Spring>& spring_keys() {
//     static const Keys<Spring> keys("spring", "a coil spring", [](auto& key, Spring& spring) {
//       key.number("rate_n_m", spring.rate, Range::positive(), "force over deflection").required();
//       key.number("length_mm", spring.length, Range::between(1.0, 1e4), "without force");
//       key.flag("guided", spring.is_guided, "a rod keeps it straight");
//     });
//     return keys;
//   }
//
//   const Spring spring = spring_keys().read(config.table("spring"));
//
// A row gives the name, whose end is the unit (key_units.hpp); the member, which gets SI; the range
// in the key's unit; the meaning. The default is what the struct has. Rules between keys are said
// by required(), needs(), excludes(), required_with(); what they cannot say is a check().
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/units.hpp"
#include "core/keys/row.hpp"
#include "core/keys/table.hpp"

namespace clatter::keys {

/// Rows that do not depend on the struct: members are known by their offset in it.
class Rows {
 public:
  Rows(Table& table, const void* standard, size_t size)
      : table_(table), standard_(static_cast<const std::byte*>(standard)), size_(size) {}

  /// A default outside the range means that there is none.
  Row number(std::string name, double& at, Range range, std::string meaning);
  /// Optional members are absent without the key, unless they have a value as a default.
  Row number(std::string name, std::optional<double>& at, Range range, std::string meaning);
  Row integer(std::string name, int& at, Range range, std::string meaning);
  Row integer(std::string name, std::optional<int>& at, Range range, std::string meaning);
  Row flag(std::string name, bool& at, std::string meaning);
  Row flag(std::string name, std::optional<bool>& at, std::string meaning);
  Row text(std::string name, std::string& at, std::string meaning);
  /// A text that names a group of a result file: not empty, without '/'.
  Row name(std::string name, std::string& at, std::string meaning);
  /// A text that is one of these.
  Row choice(std::string name, std::string& at, std::vector<std::string> choices,
             std::string meaning);
  /// A consistent system of units.
  Row units(std::string name, UnitSystem& at, std::string meaning);
  Row path(std::string name, std::filesystem::path& at, std::string meaning);
  Row numbers(std::string name, std::vector<double>& at, Range each, std::string meaning);
  Row texts(std::string name, std::vector<std::string>& at, std::string meaning);
  /// As many numbers as the member has.
  template <int n>
  Row vector(const std::string& name, Eigen::Matrix<double, n, 1>& at, Range each,
             const std::string& meaning) {
    return fixed(name, at.data(), static_cast<size_t>(n), each, meaning);
  }
  template <size_t n>
  Row vector(const std::string& name, std::array<double, n>& at, Range each,
             const std::string& meaning) {
    return fixed(name, at.data(), n, each, meaning);
  }
  Row vector(std::string name, std::optional<Eigen::Vector3d>& at, Range each, std::string meaning);
  /// Three numbers that are not all 0; the member gets length 1.
  Row direction(const std::string& name, Eigen::Vector3d& at, const std::string& meaning);
  Row direction(std::string name, std::optional<Eigen::Vector3d>& at, std::string meaning);
  /// A number, or a list of them.
  Row one_or_more(std::string name, std::vector<double>& at, Range each, std::string meaning);
  /// Two numbers, the second above the first.
  Row interval(std::string name, std::optional<std::pair<double, double>>& at, std::string meaning);
  /// A table of numbers whose keys are names.
  Row by_name(std::string name, std::map<std::string, double>& at, Range each, std::string meaning);
  /// The unit of lengths that have none in their name [m]; before the rows that it scales.
  Row length_unit(std::string name, double& at, std::vector<std::pair<std::string, double>> units,
                  std::string meaning);
  /// Two rows, of which one is given, fill the same member in different units: `is_second` says
  /// which.
  void in_either(const std::string& first, const std::string& second, bool& is_second);

 protected:
  /// std::logic_error for what is no member of the struct itself, but of a vector or optional in
  /// it, and for a second key of a name: mistakes in a table, not in a file.
  size_t offset_of(const void* member) const;
  void require_new(const std::string& name) const;
  Key& add(std::string name, Type type, const void* member, std::string meaning);
  /// Index of a text among the choices of a key.
  static size_t choice_of(const Key& key, const Config& table, const std::string& text);
  /// `count` numbers, the first of which is at `at`.
  Row fixed(std::string name, const double* at, size_t count, Range each, std::string meaning);
  /// `values` are those of the choices, byte by byte.
  Row add_choice(std::string name, const void* member, std::vector<std::string> choices,
                 std::vector<std::byte> values, std::string meaning);
  /// The texts of a list, each one of the row's choices; `standard` without the key.
  static std::vector<std::string> read_choices(const Key& row, const Config& table,
                                               const std::vector<std::string>& standard);
  static std::string in_toml(const std::vector<std::string>& texts);
  /// Refuses tables of a list with the same text where it has to be distinct.
  static void check_distinct(const Table& keys, const std::vector<Config>& tables);

  Table& table_;
  const std::byte* standard_;
  size_t size_;
};

/// The keys of a TOML table that fills a struct S; S() or `standard` has the defaults.
template <class S>
class Keys : private Rows {
 public:
  /// `describe(key, s)` adds the rows by calls of `key`, with members of `s`.
  template <class Describe>
  Keys(std::string name, std::string meaning, const Describe& describe, S standard = S())
      : Rows(data_, &standard_, sizeof(S)),
        data_(std::move(name), std::move(meaning)),
        standard_(std::move(standard)) {
    describe(*this, standard_);
    data_.write_standards(reinterpret_cast<const std::byte*>(&standard_));
  }
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  const Table& table() const { return data_; }
  const S& standard() const { return standard_; }

  /// As Table::read(), with the checks.
  S read(const Config& config) const {
    S result = standard_;
    read(config, result);
    return result;
  }
  /// All values of `s` as TOML that read() reads back to the same.
  std::string toml_of(const S& s) const {
    return data_.toml_of(reinterpret_cast<const std::byte*>(&s));
  }
  /// The same for people: without defaults, with the comments of its sources.
  std::string text_of(const S& s) const {
    return data_.text_of(reinterpret_cast<const std::byte*>(&s));
  }
  /// Refuses numbers outside their range in a struct that no file gave.
  void check_ranges(const S& s) const {
    data_.check_ranges(reinterpret_cast<const std::byte*>(&s));
  }
  /// The same over values that `result` has already.
  void read(const Config& config, S& result) const {
    data_.read(config, reinterpret_cast<std::byte*>(&result));
    for (const auto& check : checks_) check(config, result);
  }

  using Rows::by_name;
  using Rows::choice;
  using Rows::direction;
  using Rows::flag;
  using Rows::in_either;
  using Rows::integer;
  using Rows::interval;
  using Rows::length_unit;
  using Rows::name;
  using Rows::number;
  using Rows::numbers;
  using Rows::one_or_more;
  using Rows::path;
  using Rows::text;
  using Rows::texts;
  using Rows::units;
  using Rows::vector;

  /// The member gets "file:line" of the table for messages of later checks, or with `key`
  /// "file:line: table.key" of that key.
  void where(std::string& at, const std::string& key = "") {
    checks_.push_back([offset = offset_of(&at), key](const Config& config, S& s) {
      *reinterpret_cast<std::string*>(reinterpret_cast<std::byte*>(&s) + offset) =
          key.empty() ? config.where() : config.where(key);
    });
  }

  /// The member gets the table itself, for messages of later checks.
  void source(Source& at) { data_.source_ = offset_of(&at); }

  /// A text of which each stands for a value; an optional member is absent without the key.
  template <class E>
  Row choice(std::string name, std::optional<E>& at,
             std::initializer_list<std::pair<const char*, std::type_identity_t<E>>> choices,
             std::string meaning) {
    std::vector<std::pair<std::string, E>> known(choices.begin(), choices.end());
    Key& key = add(std::move(name), Type::kChoice, &at, std::move(meaning));
    for (const auto& one : known) key.choices.push_back(one.first);
    key.read = [known](const Key& row, const Config& config, std::byte* bytes) {
      auto& member = *reinterpret_cast<std::optional<E>*>(bytes);
      if (row.required || config.has(row.name))
        member = known[choice_of(row, config, config.text(row.name))].second;
      for (const auto& one : known)
        if (member && *member == one.second) config.text_or(row.name, one.first);
    };
    key.written = [known](const Key&, const std::byte* member) {
      const auto& value = *reinterpret_cast<const std::optional<E>*>(member);
      for (const auto& one : known)
        if (value && *value == one.second) return "\"" + one.first + "\"";
      return std::string();
    };
    return Row(key);
  }
  template <class E>
  Row choice(std::string name, E& at,
             std::initializer_list<std::pair<const char*, std::type_identity_t<E>>> choices,
             std::string meaning) {
    static_assert(std::is_trivially_copyable_v<E>);
    std::vector<std::string> names;
    std::vector<std::byte> values;
    for (const auto& [text, value] : choices) {
      names.emplace_back(text);
      const auto* bytes = reinterpret_cast<const std::byte*>(&value);
      values.insert(values.end(), bytes, bytes + sizeof(E));
    }
    return add_choice(std::move(name), &at, std::move(names), std::move(values),
                      std::move(meaning));
  }

  /// A list of texts, each of which sets a flag of a struct; the others are false.
  template <class T>
  Row flags(std::string name, T& at, std::vector<std::pair<std::string, bool T::*>> choices,
            std::string meaning) {
    Key& key = add(std::move(name), Type::kTexts, &at, std::move(meaning));
    for (const auto& [text, flag] : choices) key.choices.push_back(text);
    key.read = [choices](const Key& row, const Config& table, std::byte* bytes) {
      auto& member = *reinterpret_cast<T*>(bytes);
      std::vector<std::string> standard;
      for (const auto& [text, flag] : choices)
        if (member.*flag) standard.push_back(text);
      const std::vector<std::string> texts = read_choices(row, table, standard);
      for (const auto& [text, flag] : choices)
        member.*flag = std::find(texts.begin(), texts.end(), text) != texts.end();
    };
    key.written = [choices](const Key&, const std::byte* bytes) {
      std::vector<std::string> texts;
      for (const auto& [text, flag] : choices)
        if (reinterpret_cast<const T*>(bytes)->*flag) texts.push_back(text);
      return in_toml(texts);
    };
    return Row(key);
  }

  /// A table of its own; its struct keeps its defaults without it.
  template <class T>
  Row table(std::string name, T& at, const Keys<T>& keys, std::string meaning = "") {
    return sub(
        std::move(name), Type::kTable, &at, keys, std::move(meaning),
        [&keys](const Config& parent, const Key& key, T& member) {
          if (key.required || parent.has(key.name)) keys.read(parent.table(key.name), member);
        },
        [](const T& member, const auto& see) { see("", member); });
  }
  /// Absent without the table.
  template <class T>
  Row table(std::string name, std::optional<T>& at, const Keys<T>& keys, std::string meaning = "") {
    return sub(
        std::move(name), Type::kTable, &at, keys, std::move(meaning),
        [&keys](const Config& parent, const Key& key, std::optional<T>& member) {
          if (key.required || parent.has(key.name)) member = keys.read(parent.table(key.name));
        },
        [](const std::optional<T>& member, const auto& see) {
          if (member) see("", *member);
        });
  }
  /// [[tables]], none or more; with the key those of the default go.
  template <class T>
  Row tables(std::string name, std::vector<T>& at, const Keys<T>& keys, std::string meaning = "") {
    Row row = sub(
        std::move(name), Type::kTables, &at, keys, std::move(meaning),
        [&keys](const Config& parent, const Key& key, std::vector<T>& member) {
          if (parent.has(key.name)) member.clear();
          const std::vector<Config> all = parent.tables(key.name);
          for (const Config& one : all) member.push_back(keys.read(one));
          if (key.required && member.empty())
            parent.fail(key.name, "found none, expected at least one table");
          check_distinct(keys.table(), all);
        },
        [](const std::vector<T>& member, const auto& see) {
          for (const T& one : member) see("", one);
        });
    data_.keys_.back().written = [](const Key&, const std::byte* bytes) -> std::string {
      return reinterpret_cast<const std::vector<T>*>(bytes)->empty() ? "[]" : "";
    };
    return row;
  }
  /// A table whose keys are names, each with a table.
  template <class T>
  Row named(std::string name, std::map<std::string, T>& at, const Keys<T>& keys,
            std::string meaning = "") {
    return sub(
        std::move(name), Type::kNamed, &at, keys, std::move(meaning),
        [&keys](const Config& parent, const Key& key, std::map<std::string, T>& member) {
          const auto found = parent.find_table(key.name);
          for (const std::string& one : found ? found->keys() : std::vector<std::string>())
            member[one] = keys.read(found->table(one));
        },
        [](const std::map<std::string, T>& member, const auto& see) {
          for (const auto& [one, value] : member) see(one, value);
        });
  }
  /// A key with a reader of its own: read(config, key, member) is called when the key is there.
  /// `shape` says what may be written: "a number or a list of numbers". write(key, member) gives it
  /// back as TOML.
  template <class T, class Read, class Write>
  Row value(std::string name, T& at, std::string shape, std::string meaning, const Read& read,
            const Write& write) {
    const Row row = value(std::move(name), at, std::move(shape), std::move(meaning), read);
    data_.keys_.back().written = [write](const Key& self, const std::byte* member) -> std::string {
      return write(self, *reinterpret_cast<const T*>(member));
    };
    return row;
  }
  template <class T, class Read>
  Row value(std::string name, T& at, std::string shape, std::string meaning, const Read& read) {
    Key& key = add(std::move(name), Type::kEither, &at, std::move(meaning));
    key.shape = std::move(shape);
    key.read = [read](const Key& row, const Config& config, std::byte* member) {
      if (config.has(row.name)) read(config, row.name, *reinterpret_cast<T*>(member));
    };
    return Row(key);
  }

  /// All keys of another struct, in this table.
  template <class T>
  void part(T& at, const Keys<T>& keys) {
    const size_t offset = offset_of(&at);
    for (Key key : keys.table().keys()) {
      key.offset += offset;
      require_new(key.name);
      data_.keys_.push_back(std::move(key));
    }
    for (const auto& group : keys.table().alternatives()) data_.alternatives_.push_back(group);
    for (const auto& one : keys.checks_)
      checks_.push_back([one, offset](const Config& config, S& s) {
        one(config, *reinterpret_cast<T*>(reinterpret_cast<std::byte*>(&s) + offset));
      });
  }

  /// All rows that `add()` adds need `other`, as Row::needs() says.
  template <class Add>
  void all_need(const std::string& other, const Values& values, const std::string& reason,
                const Add& add) {
    const size_t first = data_.keys_.size();
    add();
    for (size_t k = first; k < data_.keys_.size(); ++k)
      Row(data_.keys_[k]).needs(other, values, reason);
  }
  /// Exactly one of these keys is given.
  void one_of(std::vector<std::string> names) { data_.alternatives_.push_back(std::move(names)); }
  /// Other readers take further keys of the same TOML table: unknown ones are theirs to refuse.
  void shared() { data_.shared_ = true; }
  /// act(config, s) is called when the rows so far were read: for what later rows need of them.
  void then(const std::function<void(const Config&, S&)>& act) {
    Key& key = data_.keys_.back();
    key.read = [read = key.read, act, offset = key.offset](const Key& row, const Config& config,
                                                           std::byte* member) {
      read(row, config, member);
      act(config, *reinterpret_cast<S*>(member - offset));
    };
  }
  /// check(config, s) is called after all keys were read: it fails for values that do not go
  /// together, and may set members that follow from several keys.
  void check(std::function<void(const Config&, S&)> check) { checks_.push_back(std::move(check)); }

 private:
  template <class T>
  friend class Keys;

  template <class M, class T, class Read, class Each>
  Row sub(std::string name, Type type, M* at, const Keys<T>& keys, std::string meaning,
          const Read& read, const Each& each) {
    Key& key = add(std::move(name), type, at, meaning.empty() ? keys.table().meaning() : meaning);
    key.table = &keys.table();
    key.read = [read](const Key& row, const Config& config, std::byte* member) {
      read(config, row, *reinterpret_cast<M*>(member));
    };
    key.each = [each](const std::byte* member, const Key::See& see) {
      each(*reinterpret_cast<const M*>(member), [&see](const std::string& one, const T& object) {
        see(one, reinterpret_cast<const std::byte*>(&object));
      });
    };
    return Row(key);
  }

  Table data_;
  S standard_;
  std::vector<std::function<void(const Config&, S&)>> checks_;
};

}  // namespace clatter::keys
