// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/parameters.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesh/deck/field_text.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

using Value = Parameters::Value;
using Function = double (*)(double);

constexpr std::array<std::pair<std::string_view, Function>, 8> kFunctions = {
    {{"sqrt", [](double x) { return std::sqrt(x); }},
     {"sin", [](double x) { return std::sin(x); }},
     {"cos", [](double x) { return std::cos(x); }},
     {"tan", [](double x) { return std::tan(x); }},
     {"atan", [](double x) { return std::atan(x); }},
     {"exp", [](double x) { return std::exp(x); }},
     {"log", [](double x) { return std::log(x); }},
     {"abs", [](double x) { return std::abs(x); }}}};

constexpr int kDeepestNesting = 64;  // parentheses in each other

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// sum -> product {+- product}, product -> power {*/ power}, power -> [-] atom [** power].
class Expression {
 public:
  Expression(std::string_view text, const std::map<std::string, Value>& known, const Source& source,
             Origin origin)
      : rest_(text), all_(text), known_(known), source_(source), origin_(origin) {}

  Value run() {
    const Value value = sum();
    if (!trimmed(rest_).empty()) fail();
    if (!std::isfinite(value.number)) fail();
    return value;
  }

 private:
  [[noreturn]] void fail() const {
    source_.fail(origin_, fmt::format("*PARAMETER: found {}, expected an expression of numbers, "
                                      "names defined before, + - * / ** and sqrt, sin, cos, tan, "
                                      "atan, exp, log, abs",
                                      shown(all_)));
  }

  bool take(std::string_view symbol) {
    rest_ = trimmed(rest_);
    if (!rest_.starts_with(symbol)) return false;
    if (symbol == "*" && rest_.starts_with("**")) return false;
    rest_.remove_prefix(symbol.size());
    return true;
  }

  Value sum() {
    if (++depth_ > kDeepestNesting) fail();
    Value left = product();
    while (true) {
      const bool plus = take("+");
      if (!plus && !take("-")) break;
      const Value right = product();
      left = {plus ? left.number + right.number : left.number - right.number,
              left.is_integer && right.is_integer,
              {}};
    }
    --depth_;
    return left;
  }

  Value product() {
    Value left = power();
    while (true) {
      const bool times = take("*");
      if (!times && !take("/")) return left;
      const Value right = power();
      const bool integers = left.is_integer && right.is_integer;
      const double number = times ? left.number * right.number : left.number / right.number;
      if (!times && integers && number != std::floor(number)) {
        source_.fail(origin_, fmt::format("*PARAMETER: {} divides integers with a remainder, which "
                                          "Abaqus cuts off or not by its version; write 1. for 1",
                                          shown(all_)));
      }
      left = {number, integers, {}};
    }
  }

  Value power() {
    if (++depth_ > kDeepestNesting) fail();
    Value value;
    if (take("-")) {
      value = power();
      value.number = -value.number;
    } else if (take("+")) {
      value = power();
    } else {
      value = atom();
      if (take("**")) {
        const Value exponent = power();
        value = {std::pow(value.number, exponent.number),
                 value.is_integer && exponent.is_integer && exponent.number >= 0.0,
                 {}};
      }
    }
    --depth_;
    return value;
  }

  Value atom() {
    if (take("(")) {
      const Value inside = sum();
      if (!take(")")) fail();
      return inside;
    }
    rest_ = trimmed(rest_);
    size_t end = 0;
    const bool number =
        !rest_.empty() &&
        (std::isdigit(static_cast<unsigned char>(rest_[0])) != 0 || rest_[0] == '.');
    while (end < rest_.size() && (is_word(rest_[end]) || (number && is_part(end)))) ++end;
    const std::string word(rest_.substr(0, end));
    rest_.remove_prefix(end);
    if (number) {
      const auto value = to_number(word);
      if (!value) fail();
      return {*value, word.find_first_not_of("0123456789") == std::string::npos, {}};
    }
    if (const auto known = known_.find(word); known != known_.end() && !known->second.text) {
      return known->second;
    }
    for (const auto& [name, function] : kFunctions) {
      if (name == word && take("(")) {
        const Value inside = sum();
        if (!take(")")) fail();
        return {function(inside.number), false, {}};
      }
    }
    if (word == "pi") return {std::numbers::pi, false, {}};
    fail();
  }

  // The point of a number, or the sign of its exponent.
  bool is_part(size_t at) const {
    const char c = rest_[at];
    if (c == '.') return true;
    const char before = at == 0 ? ' ' : rest_[at - 1];
    return (c == '+' || c == '-') && (before == 'e' || before == 'E');
  }

  std::string_view rest_, all_;
  const std::map<std::string, Value>& known_;
  const Source& source_;
  Origin origin_;
  int depth_ = 0;
};

std::string text_of(const Value& value) {
  if (value.text) return *value.text;
  return value.is_integer ? fmt::format("{:.0f}", value.number) : fmt::format("{}", value.number);
}

}  // namespace

void Parameters::define(std::string_view line, const Source& source, Origin origin) {
  line = trimmed(line.substr(0, line.find('#')));
  if (line.empty()) return;
  const size_t equals = line.find('=');
  const std::string name(trimmed(line.substr(0, equals)));
  bool good = equals != std::string_view::npos && !name.empty();
  for (const char c : name) good = good && is_word(c);
  if (!good) source.fail(origin, fmt::format("found {}, expected name = number", shown(line)));
  const std::string_view right = trimmed(line.substr(equals + 1));
  const bool quoted = right.size() >= 2 && right.front() == right.back() &&
                      (right.front() == '\'' || right.front() == '"');
  values_[name] = quoted ? Value{0.0, false, std::string(right.substr(1, right.size() - 2))}
                         : Expression(right, values_, source, origin).run();
}

std::string Parameters::replaced(std::string_view line, const Source& source, Origin origin) const {
  std::string out;
  while (true) {
    const size_t open = line.find('<');
    const size_t close = open == line.npos ? line.npos : line.find('>', open);
    out += line.substr(0, open == line.npos || close == line.npos ? line.size() : open);
    if (close == line.npos) return out;
    const std::string name(trimmed(line.substr(open + 1, close - open - 1)));
    const auto known = values_.find(name);
    if (known == values_.end()) {
      source.fail(origin, fmt::format("found no parameter {} (*PARAMETER)", shown(name)));
    }
    out += text_of(known->second);
    if (out.size() > kLongestLine) source.fail(origin, "parameters make the line too long");
    line.remove_prefix(close + 1);
  }
}

}  // namespace clatter::mesh::deck::abaqus
