// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What is said of one row beside its name, member, range and meaning: see keys.hpp.
#include <initializer_list>
#include <string>
#include <vector>

#include "core/keys/key.hpp"

namespace clatter::keys {

/// None, one or several values of a choice or flag, of a rule.
struct Values {
  Values() = default;
  Values(const char* one) : all{one} {}
  Values(std::initializer_list<const char*> several) : all(several.begin(), several.end()) {}
  std::vector<std::string> all;
};

/// The row that was added last, for what not every key has.
class Row {
 public:
  explicit Row(Key& key) : key_(key) {}
  /// The table is refused without this key; of lists and tables, with none of them.
  Row& required();
  /// Refused without the key `other`, or where that choice or flag has another value.
  Row& needs(std::string other, Values values = {}, std::string reason = "");
  Row& excludes(std::string other, std::string reason = "");
  /// Refused without this key where `other` is given, or has this value.
  Row& required_with(std::string other, Values values = {});
  /// Both: a key of that choice alone, which cannot do without.
  Row& of(const std::string& other, const Values& values = {});
  /// A list as long as the list `other`.
  Row& as_many_as(std::string other);
  /// A list of numbers, each above the one before.
  Row& ascending();
  /// A length without a unit in its name: in that of the file, which length_unit() reads.
  Row& in_length_unit();
  /// Of a list: exactly so many.
  Row& count(size_t count);
  /// Of a list of texts: each is one of these.
  Row& each_of(std::vector<std::string> choices);
  /// Of a text: no other table of the list has the same.
  Row& distinct();
  /// Of value(): what may be written.
  Row& types(std::vector<Type> types);
  /// The unit as shown, where the name's end has two meanings: N m, not N/m.
  Row& shown_in(std::string unit);
  /// The member keeps the number in the key's unit.
  Row& unconverted();
  /// The member gets `factor` times the value: 0.5 for a radius given as a diameter.
  Row& times(double factor);
  /// A text for people has it also where it is the default.
  Row& always();
  /// Of tables(): a text has each on a line, in braces.
  Row& one_line();
  /// Of a list: a text has the rows of a lower triangle on lines.
  Row& triangle();

 private:
  Key& key_;
};

}  // namespace clatter::keys
