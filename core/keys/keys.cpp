// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace clatter::keys {
namespace {

template <class T>
T& member(std::byte* bytes) {
  return *reinterpret_cast<T*>(bytes);
}

template <class T>
const T& member(const std::byte* bytes) {
  return *reinterpret_cast<const T*>(bytes);
}

double in_si(double value, const KeyUnit& unit) { return value * unit.scale + unit.offset; }

// To 15 digits: 4e-5 m is 40 um, not 39.99999999999999.
double in_unit(double value, const KeyUnit& unit) {
  const double exact = (value - unit.offset) / unit.scale;
  return std::isfinite(exact) ? std::stod(fmt::format("{:.15g}", exact)) : exact;
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// A default as it would be written; empty for a value that no file can give.
std::string shown(double value) {
  return std::isfinite(value) ? fmt::format("{:.12g}", value) : "";
}

bool inside(double value, const Range& range) {
  return std::isfinite(value) && value <= range.max &&
         (range.open_min ? value > range.min : value >= range.min);
}

/// Refuses values of a list outside its range, and out of order.
std::vector<double> checked(const Config& table, const Key& row, std::vector<double> values) {
  for (size_t k = 0; k < values.size(); ++k) {
    if (!inside(values[k], row.range))
      table.fail(row.name, fmt::format("found {:g}, expected {} {:g} and at most {:g}", values[k],
                                       row.range.open_min ? "above" : "at least", row.range.min,
                                       row.range.max));
    if (row.ascending && k > 0 && !(values[k] > values[k - 1]))
      table.fail(row.name, fmt::format("found {:g} after {:g}, expected ascending values",
                                       values[k], values[k - 1]));
  }
  for (double& value : values) value = in_si(value, row.unit);
  return values;
}

std::string shown(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(shown(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

bool all_inside(const std::vector<double>& values, const Range& range) {
  return std::all_of(values.begin(), values.end(),
                     [&](double value) { return inside(value, range); });
}

/// `count` values from the first on, in the key's unit.
std::vector<double> in_unit(const double* values, size_t count, const KeyUnit& unit) {
  std::vector<double> converted(values, values + count);
  for (double& value : converted) value = in_unit(value, unit);
  return converted;
}

}  // namespace

Row& Row::required() {
  key_.required = true;
  key_.standard.clear();
  return *this;
}

Row& Row::needs(std::string other, Values values, std::string reason) {
  key_.rules.push_back(
      {Rule::Kind::kNeeds, std::move(other), std::move(values), std::move(reason)});
  return *this;
}

Row& Row::excludes(std::string other, std::string reason) {
  key_.rules.push_back({Rule::Kind::kExcludes, std::move(other), {}, std::move(reason)});
  return *this;
}

Row& Row::required_with(std::string other, Values values) {
  key_.rules.push_back({Rule::Kind::kRequiredWith, std::move(other), std::move(values), ""});
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

size_t Rows::offset_of(const void* member) const {
  const auto offset = static_cast<size_t>(static_cast<const std::byte*>(member) - standard_);
  assert(offset < size_);  // a member of the struct itself, not of a vector or optional in it
  return offset;
}

Key& Rows::add(std::string name, Type type, const void* member, std::string meaning) {
  assert(table_.find(name) == nullptr);
  Key key;
  key.unit = unit_of(name);
  key.name = std::move(name);
  key.type = type;
  key.offset = offset_of(member);
  key.meaning = std::move(meaning);
  return table_.keys_.emplace_back(std::move(key));
}

// A default is what its own text gives: number() of the value in the key's unit, then SI. One that
// is outside the range, no number that a file may give, stays as it is.
Row Rows::number(std::string name, double& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumber, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<double>(bytes);
    const double standard = in_unit(value, row.unit);
    if (row.required || table.has(row.name)) {
      value = in_si(table.number(row.name, row.range), row.unit);
    } else if (row.has_standard() && inside(standard, row.range)) {
      value = in_si(table.number_or(row.name, standard), row.unit);
    }
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const double value = in_unit(member<double>(bytes), row.unit);
    return inside(value, row.range) ? shown(value) : "";
  };
  return Row(key);
}

Row Rows::number(std::string name, std::optional<double>& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumber, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<std::optional<double>>(bytes);
    if (row.required || table.has(row.name)) {
      value = in_si(table.number(row.name, row.range), row.unit);
    } else if (value) {
      value = in_si(table.number_or(row.name, in_unit(*value, row.unit)), row.unit);
    }
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const auto& value = member<std::optional<double>>(bytes);
    return value ? shown(in_unit(*value, row.unit)) : "";
  };
  return Row(key);
}

Row Rows::integer(std::string name, int& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kInteger, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<int>(bytes);
    value = static_cast<int>(row.required ? table.integer(row.name, row.range)
                                          : table.integer_or(row.name, value, row.range));
  };
  key.written = [](const Key&, const std::byte* bytes) {
    return fmt::format("{}", member<int>(bytes));
  };
  return Row(key);
}

Row Rows::integer(std::string name, std::optional<int>& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kInteger, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<std::optional<int>>(bytes);
    if (row.required || table.has(row.name) || value)
      value = static_cast<int>(value ? table.integer_or(row.name, *value, row.range)
                                     : table.integer(row.name, row.range));
  };
  return Row(key);
}

Row Rows::flag(std::string name, std::optional<bool>& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kFlag, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<std::optional<bool>>(bytes);
    if (table.has(row.name) || value) value = table.flag_or(row.name, value.value_or(false));
  };
  return Row(key);
}

Row Rows::flag(std::string name, bool& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kFlag, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<bool>(bytes);
    value = table.flag_or(row.name, value);
  };
  key.written = [](const Key&, const std::byte* bytes) {
    return std::string(member<bool>(bytes) ? "true" : "false");
  };
  return Row(key);
}

Row Rows::text(std::string name, std::string& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kText, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<std::string>(bytes);
    if (row.required || table.has(row.name)) value = table.text(row.name);
    if (!table.has(row.name) && !value.empty()) value = table.text_or(row.name, value);
  };
  key.written = [](const Key&, const std::byte* bytes) {
    const auto& value = member<std::string>(bytes);
    return value.empty() ? "" : quoted(value);
  };
  return Row(key);
}

size_t Rows::choice_of(const Key& key, const Config& table, const std::string& text) {
  const auto at = std::find(key.choices.begin(), key.choices.end(), text);
  if (at == key.choices.end())
    table.fail(key.name, fmt::format("found \"{}\", expected one of: {}", text,
                                     fmt::join(key.choices, ", ")));
  return static_cast<size_t>(at - key.choices.begin());
}

Row Rows::add_choice(std::string name, const void* at, std::vector<std::string> choices,
                     std::vector<std::byte> values, std::string meaning) {
  Key& key = add(std::move(name), Type::kChoice, at, std::move(meaning));
  const size_t bytes_each = values.size() / choices.size();
  const auto index_of = [values, bytes_each](const Key& row, const std::byte* bytes) {
    for (size_t k = 0; k < row.choices.size(); ++k)
      if (std::memcmp(bytes, &values[k * bytes_each], bytes_each) == 0) return k;
    return row.choices.size();
  };
  key.choices = std::move(choices);
  key.read = [values, bytes_each, index_of](const Key& row, const Config& table, std::byte* bytes) {
    const size_t standard = index_of(row, bytes);
    const std::string text = row.required || standard == row.choices.size()
                                 ? table.text(row.name)
                                 : table.text_or(row.name, row.choices[standard]);
    std::memcpy(bytes, &values[choice_of(row, table, text) * bytes_each], bytes_each);
  };
  key.written = [index_of](const Key& row, const std::byte* bytes) {
    const size_t k = index_of(row, bytes);
    return k == row.choices.size() ? "" : quoted(row.choices[k]);
  };
  return Row(key);
}

Row Rows::path(std::string name, std::filesystem::path& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kPath, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (row.required || table.has(row.name))
      member<std::filesystem::path>(bytes) = table.path(row.name);
  };
  return Row(key);
}

Row Rows::numbers(std::string name, std::vector<double>& at, Range each, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, &at, std::move(meaning));
  key.range = each;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& values = member<std::vector<double>>(bytes);
    if (row.required || table.has(row.name)) {
      values = checked(table, row, table.numbers(row.name));
    } else if (!values.empty()) {
      const auto standard = in_unit(values.data(), values.size(), row.unit);
      values = checked(table, row, table.numbers_or(row.name, standard));
    }
    if (row.required && values.empty()) table.fail(row.name, "found none, expected a number");
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const auto& values = member<std::vector<double>>(bytes);
    return values.empty() ? "" : shown(in_unit(values.data(), values.size(), row.unit));
  };
  return Row(key);
}

Row Rows::one_or_more(std::string name, std::vector<double>& at, Range each, std::string meaning) {
  Key& key = add(std::move(name), Type::kEither, &at, std::move(meaning));
  key.range = each;
  key.shape = "number, or list of numbers";
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (!row.required && !table.has(row.name)) return;
    member<std::vector<double>>(bytes) = checked(
        table, row,
        table.is_list(row.name) ? table.numbers(row.name) : std::vector{table.number(row.name)});
    if (member<std::vector<double>>(bytes).empty())
      table.fail(row.name, "found none, expected a number");
  };
  return Row(key);
}

Row Rows::texts(std::string name, std::vector<std::string>& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kTexts, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& values = member<std::vector<std::string>>(bytes);
    values = row.required ? table.texts(row.name) : table.texts_or(row.name, values);
    if (row.required && values.empty()) table.fail(row.name, "found none, expected a text");
  };
  key.written = [](const Key&, const std::byte* bytes) {
    std::vector<std::string> texts;
    for (const std::string& value : member<std::vector<std::string>>(bytes))
      texts.push_back(quoted(value));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  };
  return Row(key);
}

Row Rows::fixed(std::string name, const double* at, size_t count, Range each, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, at, std::move(meaning));
  key.range = each;
  key.count = count;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    double* values = &member<double>(bytes);
    std::vector<double> given = in_unit(values, row.count, row.unit);
    if (row.required || table.has(row.name)) {
      given = checked(table, row, table.numbers(row.name, row.count));
    } else if (row.has_standard() && all_inside(given, row.range)) {
      given = checked(table, row, table.numbers_or(row.name, given));
    } else {
      return;
    }
    std::copy(given.begin(), given.end(), values);
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const auto given = in_unit(&member<double>(bytes), row.count, row.unit);
    return all_inside(given, row.range) ? shown(given) : "";
  };
  return Row(key);
}

Row Rows::vector(std::string name, std::optional<Eigen::Vector3d>& at, Range each,
                 std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, &at, std::move(meaning));
  key.range = each;
  key.count = 3;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (!row.required && !table.has(row.name)) return;
    const std::vector<double> values = checked(table, row, table.numbers(row.name, 3));
    member<std::optional<Eigen::Vector3d>>(bytes) = Eigen::Vector3d(values.data());
  };
  return Row(key);
}

Row Rows::direction(std::string name, Eigen::Vector3d& at, std::string meaning) {
  Row row = vector(std::move(name), at, Range::between(-1e6, 1e6), std::move(meaning));
  Key& key = table_.keys_.back();
  key.read = [read = key.read](const Key& self, const Config& table, std::byte* bytes) {
    read(self, table, bytes);
    auto& direction = member<Eigen::Vector3d>(bytes);
    if (!table.has(self.name)) return;
    if (!(direction.norm() > 0.0)) table.fail(self.name, "found length 0, expected a direction");
    direction.normalize();
  };
  return row;
}

}  // namespace clatter::keys
