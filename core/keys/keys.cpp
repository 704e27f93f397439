// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of numbers and flags, and what all rows have in common.
#include "core/keys/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/keys/member.hpp"

namespace clatter::keys {
namespace {

double in_si(double value, const KeyUnit& unit, const Config& table) {
  return value * (unit.of_file ? table.metre() * unit.scale : unit.scale) + unit.offset;
}

// To 15 digits: 4e-5 m is 40 um, not 39.99999999999999. In the unit itself all digits.
double in_unit(double value, const KeyUnit& unit, double metre = 1.0) {
  if (unit.scale == 1.0 && unit.offset == 0.0 && (!unit.of_file || metre == 1.0)) return value;
  return rounded((value - unit.offset) / (unit.of_file ? metre * unit.scale : unit.scale), 15);
}

std::string shown(double value) { return fmt::format("{}", value); }

bool is_inside(const Range& range, double value) {
  return std::isfinite(value) && value <= range.max &&
         (range.open_min ? value > range.min : value >= range.min);
}

/// A value as it would be written; empty for one that no file can give, which means that there is
/// none.
std::string shown(const Range& range, double value) {
  return is_inside(range, value) ? shown(value) : "";
}

/// Whether the key is left out and has no default.
bool is_absent(const Key& row, const Config& table) {
  return !row.required && row.standard.empty() && !table.has(row.name);
}

/// Refuses values of a list outside its range.
void check_each(const Config& table, const std::string& name, const Range& range,
                const std::vector<double>& values) {
  for (const double value : values) {
    if (!is_inside(range, value))
      table.fail(name, fmt::format("found {:g}, expected {}", value, expectation(range)));
  }
}

std::optional<double> first_outside(const Key& row, const double* values, size_t count) {
  for (size_t k = 0; k < count; ++k)
    if (const double value = in_unit(values[k], row.unit); !is_inside(row.range, value))
      return value;
  return std::nullopt;
}

std::vector<double> read_list(const Config& table, const Key& row) {
  std::vector<double> values =
      row.count > 0 ? table.numbers(row.name, row.count) : table.numbers(row.name);
  check_each(table, row.name, row.range, values);
  if (row.required && values.empty()) table.fail(row.name, "found none, expected a number");
  for (size_t k = 1; k < values.size(); ++k)
    if (row.ascending && !(values[k] > values[k - 1]))
      table.fail(row.name, fmt::format("found {:g} after {:g}, expected ascending values",
                                       values[k], values[k - 1]));
  for (double& value : values) value = in_si(value, row.unit, table);
  return values;
}

std::string written_list(const Key& row, const double* values, size_t count) {
  std::vector<std::string> texts;
  for (size_t k = 0; k < count; ++k) texts.push_back(shown(in_unit(values[k], row.unit)));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

size_t Rows::offset_of(const void* member) const {
  const auto offset = static_cast<size_t>(static_cast<const std::byte*>(member) - standard_);
  if (offset >= size_)
    throw std::logic_error(table_.name() + ": a row's member is not in the struct itself");
  return offset;
}

void Rows::require_new(const std::string& name) const {
  if (table_.find(name) != nullptr)
    throw std::logic_error(table_.name() + ": two rows of the name " + name);
}

Key& Rows::add(std::string name, Type type, const void* member, std::string meaning) {
  require_new(name);
  Key key;
  key.unit = unit_of(name);
  key.name = std::move(name);
  key.type = type;
  key.offset = offset_of(member);
  key.meaning = std::move(meaning);
  return table_.keys_.emplace_back(std::move(key));
}

// A default is what its own text gives: number() of the value in the key's unit, then SI.
Row Rows::number(std::string name, double& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumber, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (is_absent(row, table)) return;
    auto& value = member<double>(bytes);
    const double standard = in_unit(value, row.unit, table.metre());
    value = in_si(row.required ? table.number(row.name, row.range)
                               : table.number_or(row.name, standard, row.range),
                  row.unit, table);
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    return shown(row.range, in_unit(member<double>(bytes), row.unit));
  };
  key.outside = [](const Key& row, const std::byte* bytes) {
    return first_outside(row, &member<double>(bytes), 1);
  };
  return Row(key);
}

Row Rows::number(std::string name, std::optional<double>& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumber, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<std::optional<double>>(bytes);
    if (row.required || table.has(row.name)) {
      value = in_si(table.number(row.name, row.range), row.unit, table);
    } else if (value) {
      table.number_or(row.name, in_unit(*value, row.unit, table.metre()));
    }
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const auto& value = member<std::optional<double>>(bytes);
    return value ? shown(in_unit(*value, row.unit)) : "";
  };
  key.outside = [](const Key& row, const std::byte* bytes) {
    const auto& value = member<std::optional<double>>(bytes);
    return value ? first_outside(row, &*value, 1) : std::nullopt;
  };
  return Row(key);
}

Row Rows::integer(std::string name, int& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kInteger, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (is_absent(row, table)) return;
    auto& value = member<int>(bytes);
    value = static_cast<int>(row.required ? table.integer(row.name, row.range)
                                          : table.integer_or(row.name, value, row.range));
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    return shown(row.range, member<int>(bytes));
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
  key.written = [](const Key&, const std::byte* bytes) {
    const auto& value = member<std::optional<int>>(bytes);
    return value ? fmt::format("{}", *value) : "";
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

Row Rows::flag(std::string name, std::optional<bool>& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kFlag, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<std::optional<bool>>(bytes);
    if (table.has(row.name) || value) value = table.flag_or(row.name, value.value_or(false));
  };
  key.written = [](const Key&, const std::byte* bytes) -> std::string {
    const auto& value = member<std::optional<bool>>(bytes);
    return !value ? "" : *value ? "true" : "false";
  };
  return Row(key);
}

Row Rows::numbers(std::string name, std::vector<double>& at, Range each, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, &at, std::move(meaning));
  key.range = each;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& values = member<std::vector<double>>(bytes);
    if (row.required || table.has(row.name)) {
      values = read_list(table, row);
      return;
    }
    if (values.empty()) return;
    for (double& value : values) value = in_unit(value, row.unit, table.metre());
    table.numbers_or(row.name, values);
    for (double& value : values) value = in_si(value, row.unit, table);
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const auto& values = member<std::vector<double>>(bytes);
    return written_list(row, values.data(), values.size());
  };
  key.outside = [](const Key& row, const std::byte* bytes) {
    const auto& values = member<std::vector<double>>(bytes);
    return first_outside(row, values.data(), values.size());
  };
  return Row(key);
}

Row Rows::one_or_more(std::string name, std::vector<double>& at, Range each, std::string meaning) {
  Row row = numbers(std::move(name), at, each, std::move(meaning));
  Key& key = table_.keys_.back();
  key.type = Type::kEither;
  key.types = {Type::kNumber, Type::kNumbers};
  key.shape = "a number or a list of numbers";
  key.written = [written = key.written](const Key& self, const std::byte* bytes) {
    const auto& values = member<std::vector<double>>(bytes);
    return values.size() == 1 ? shown(in_unit(values[0], self.unit)) : written(self, bytes);
  };
  key.read = [read = key.read](const Key& self, const Config& table, std::byte* bytes) {
    if (!table.has(self.name) || table.is_list(self.name)) {
      read(self, table, bytes);
      if (table.has(self.name) && member<std::vector<double>>(bytes).empty())
        table.fail(self.name, "found none, expected a number");
      return;
    }
    member<std::vector<double>>(bytes) = {
        in_si(table.number(self.name, self.range), self.unit, table)};
  };
  return row;
}

Row Rows::interval(std::string name, std::optional<std::pair<double, double>>& at,
                   std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, &at, std::move(meaning));
  key.count = 2;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (!row.required && !table.has(row.name)) return;
    const std::vector<double> ends = read_list(table, row);
    if (!(ends[0] < ends[1]))
      table.fail(row.name, "found an end that is not above the beginning, expected ascending");
    member<std::optional<std::pair<double, double>>>(bytes) = {ends[0], ends[1]};
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const auto& ends = member<std::optional<std::pair<double, double>>>(bytes);
    return ends ? written_list(row, std::array{ends->first, ends->second}.data(), 2) : "";
  };
  return Row(key);
}

Row Rows::by_name(std::string name, std::map<std::string, double>& at, Range each,
                  std::string meaning) {
  Key& key = add(std::move(name), Type::kByName, &at, std::move(meaning));
  key.range = each;
  key.written = [](const Key& row, const std::byte* bytes) -> std::string {
    std::vector<std::string> all;
    for (const auto& [one, value] : member<std::map<std::string, double>>(bytes))
      all.push_back(fmt::format("{} = {}", toml_key(one), shown(in_unit(value, row.unit))));
    return all.empty() ? "" : fmt::format("{{ {} }}", fmt::join(all, ", "));
  };
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    const auto found = row.required ? table.table(row.name) : table.find_table(row.name);
    for (const std::string& one : found ? found->keys() : std::vector<std::string>())
      member<std::map<std::string, double>>(bytes)[one] =
          in_si(found->number(one, row.range), row.unit, table);
  };
  return Row(key);
}

Row Rows::fixed(std::string name, const double* at, size_t count, Range each, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, at, std::move(meaning));
  key.range = each;
  key.count = count;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (!row.required && !table.has(row.name)) return;
    const std::vector<double> values = read_list(table, row);
    std::copy(values.begin(), values.end(), &member<double>(bytes));
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const double* values = &member<double>(bytes);
    const bool can_be_given = std::all_of(values, values + row.count, [&](double value) {
      return is_inside(row.range, in_unit(value, row.unit));
    });
    return can_be_given ? written_list(row, values, row.count) : "";
  };
  return Row(key);
}

Row Rows::vector(std::string name, std::optional<Eigen::Vector3d>& at, Range each,
                 std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, &at, std::move(meaning));
  key.range = each;
  key.count = 3;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (row.required || table.has(row.name))
      member<std::optional<Eigen::Vector3d>>(bytes) = Eigen::Vector3d(read_list(table, row).data());
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const auto& value = member<std::optional<Eigen::Vector3d>>(bytes);
    return value ? written_list(row, value->data(), 3) : "";
  };
  return Row(key);
}

namespace {

Eigen::Vector3d read_direction(const Key& row, const Config& table) {
  const Eigen::Vector3d direction(read_list(table, row).data());
  if (!(direction.norm() > 0.0)) table.fail(row.name, "found length 0, expected a direction");
  return direction.normalized();
}

}  // namespace

Row Rows::direction(const std::string& name, Eigen::Vector3d& at, const std::string& meaning) {
  Row row = vector(name, at, {}, meaning);
  table_.keys_.back().read = [](const Key& self, const Config& table, std::byte* bytes) {
    if (self.required || table.has(self.name))
      member<Eigen::Vector3d>(bytes) = read_direction(self, table);
  };
  table_.keys_.back().written = [](const Key& self, const std::byte* bytes) {
    const auto& direction = member<Eigen::Vector3d>(bytes);
    return direction.isZero(0.0) ? "" : written_list(self, direction.data(), 3);
  };
  return row;
}

Row Rows::direction(std::string name, std::optional<Eigen::Vector3d>& at, std::string meaning) {
  Row row = vector(std::move(name), at, {}, std::move(meaning));
  table_.keys_.back().read = [](const Key& self, const Config& table, std::byte* bytes) {
    if (self.required || table.has(self.name))
      member<std::optional<Eigen::Vector3d>>(bytes) = read_direction(self, table);
  };
  return row;
}

void Rows::in_either(const std::string& first, const std::string& second, bool& is_second) {
  for (Key& key : table_.keys_) {
    const bool is_first = key.name == first;
    if (!is_first && key.name != second) continue;
    const auto to_flag = static_cast<std::ptrdiff_t>(offset_of(&is_second)) -
                         static_cast<std::ptrdiff_t>(key.offset);
    key.read = [=, read = key.read](const Key& row, const Config& table, std::byte* bytes) {
      if (table.has(second) ? is_first && !table.has(first) : !is_first) return;
      read(row, table, bytes);
      member<bool>(bytes + to_flag) = !is_first;
    };
    key.written = [=, written = key.written](const Key& row, const std::byte* bytes) {
      return member<bool>(bytes + to_flag) == is_first ? "" : written(row, bytes);
    };
    if (!is_first) Row(key).excludes(first);
  }
}

}  // namespace clatter::keys
