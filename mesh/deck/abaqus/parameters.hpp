// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// *PARAMETER: numbers by name, which <name> in later lines stands for.
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/deck/abaqus/source.hpp"

namespace clatter::mesh::deck::abaqus {

class Parameters {
 public:
  bool empty() const { return values_.empty(); }
  /// "name = expression": numbers, known names, + - * / **, parentheses, sqrt, sin, cos, tan, atan,
  /// exp, log, abs, pi, or a text in quotes. InputError for anything else.
  void define(std::string_view line, const Source& source, Origin origin);
  /// The line with each <name> replaced by its value; InputError for an unknown name.
  std::string replaced(std::string_view line, const Source& source, Origin origin) const;

  struct Value {
    double number = 0.0;
    bool is_integer = false;
    std::optional<std::string> text;
  };

 private:
  std::map<std::string, Value> values_;  // names as written: case matters
};

}  // namespace clatter::mesh::deck::abaqus
