// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/row.hpp"

#include <utility>

namespace clatter::keys {

Row& Row::required() {
  key_.required = true;
  key_.standard.clear();
  return *this;
}

Row& Row::needs(std::string other, Values values, std::string reason) {
  key_.rules.push_back({Rule::Kind::kNeeds, std::move(other), values.all, std::move(reason)});
  return *this;
}

Row& Row::excludes(std::string other, std::string reason) {
  key_.rules.push_back({Rule::Kind::kExcludes, std::move(other), {}, std::move(reason)});
  return *this;
}

Row& Row::required_with(std::string other, Values values) {
  key_.rules.push_back({Rule::Kind::kRequiredWith, std::move(other), values.all, ""});
  return *this;
}

Row& Row::of(const std::string& other, const Values& values) {
  needs(other, values);
  return required_with(other, values);
}

Row& Row::as_many_as(std::string other) {
  key_.rules.push_back({Rule::Kind::kAsMany, std::move(other), {}, ""});
  return *this;
}

Row& Row::ascending() {
  key_.ascending = true;
  return *this;
}

Row& Row::in_length_unit() {
  key_.unit.shown = "length_unit";
  key_.unit.of_file = true;
  return *this;
}

Row& Row::count(size_t count) {
  key_.count = count;
  return *this;
}

Row& Row::each_of(std::vector<std::string> choices) {
  key_.choices = std::move(choices);
  return *this;
}

Row& Row::distinct() {
  key_.distinct = true;
  return *this;
}

Row& Row::types(std::vector<Type> types) {
  key_.types = std::move(types);
  return *this;
}

Row& Row::shown_in(std::string unit) {
  key_.unit.shown = std::move(unit);
  return *this;
}

Row& Row::unconverted() {
  key_.unit.scale = 1.0;
  key_.unit.offset = 0.0;
  return *this;
}

Row& Row::times(double factor) {
  key_.unit.scale *= factor;
  return *this;
}

Row& Row::always() {
  key_.always = true;
  return *this;
}

Row& Row::one_line() {
  key_.one_line = true;
  return *this;
}

Row& Row::triangle() {
  key_.triangle = true;
  return *this;
}

}  // namespace clatter::keys
