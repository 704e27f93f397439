// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// Refuses values of a list outside its range.
void check_each(const Config& table, const std::string& name, const Range& range,
                const std::vector<double>& values) {
  for (const double value : values) {
    const bool above = range.open_min ? value > range.min : value >= range.min;
    if (!above || !(value <= range.max))
      table.fail(name, fmt::format("found {:g}, expected {} {:g} and at most {:g}", value,
                                   range.open_min ? "above" : "at least", range.min, range.max));
  }
}

Eigen::Vector3d read_vector(const Config& table, const std::string& name, const Range& each,
                            const KeyUnit& unit) {
  const std::vector<double> values = table.numbers(name, 3);
  check_each(table, name, each, values);
  Eigen::Vector3d vector;
  for (int k = 0; k < 3; ++k) vector[k] = in_si(values[static_cast<size_t>(k)], unit);
  return vector;
}

}  // namespace

Row& Row::required() {
  key_.required = true;
  key_.standard.clear();
  return *this;
}

Row& Row::needs(std::string other, std::string value, std::string reason) {
  key_.rules.push_back({Rule::Kind::kNeeds, std::move(other), std::move(value), std::move(reason)});
  return *this;
}

Row& Row::excludes(std::string other, std::string reason) {
  key_.rules.push_back({Rule::Kind::kExcludes, std::move(other), "", std::move(reason)});
  return *this;
}

Row& Row::required_with(std::string other, std::string value) {
  key_.rules.push_back({Rule::Kind::kRequiredWith, std::move(other), std::move(value), ""});
  return *this;
}

Row& Row::shown_in(std::string unit) {
  key_.unit.shown = std::move(unit);
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

// A default is what its own text gives: number() of the value in the key's unit, then SI.
Row Rows::number(std::string name, double& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumber, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& value = member<double>(bytes);
    value = in_si(row.required ? table.number(row.name, row.range)
                               : table.number_or(row.name, in_unit(value, row.unit), row.range),
                  row.unit);
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    return shown(in_unit(member<double>(bytes), row.unit));
  };
  return Row(key);
}

Row Rows::number(std::string name, std::optional<double>& at, Range range, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumber, &at, std::move(meaning));
  key.range = range;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (row.required || table.has(row.name))
      member<std::optional<double>>(bytes) = in_si(table.number(row.name, row.range), row.unit);
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
    value = row.required ? table.text(row.name) : table.text_or(row.name, value);
  };
  key.written = [](const Key&, const std::byte* bytes) {
    const auto& value = member<std::string>(bytes);
    return value.empty() ? "" : quoted(value);
  };
  return Row(key);
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
    for (size_t k = 0; k < row.choices.size(); ++k)
      if (text == row.choices[k]) {
        std::memcpy(bytes, &values[k * bytes_each], bytes_each);
        return;
      }
    table.fail(row.name, fmt::format("found \"{}\", expected one of: {}", text,
                                     fmt::join(row.choices, ", ")));
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
    std::vector<double> standard = values;
    for (double& value : standard) value = in_unit(value, row.unit);
    values = row.required ? table.numbers(row.name) : table.numbers_or(row.name, standard);
    check_each(table, row.name, row.range, values);
    for (double& value : values) value = in_si(value, row.unit);
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    std::vector<std::string> texts;
    for (const double value : member<std::vector<double>>(bytes))
      texts.push_back(shown(in_unit(value, row.unit)));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  };
  return Row(key);
}

Row Rows::texts(std::string name, std::vector<std::string>& at, std::string meaning) {
  Key& key = add(std::move(name), Type::kTexts, &at, std::move(meaning));
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    auto& values = member<std::vector<std::string>>(bytes);
    values = row.required ? table.texts(row.name) : table.texts_or(row.name, values);
  };
  key.written = [](const Key&, const std::byte* bytes) {
    std::vector<std::string> texts;
    for (const std::string& value : member<std::vector<std::string>>(bytes))
      texts.push_back(quoted(value));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  };
  return Row(key);
}

Row Rows::vector(std::string name, Eigen::Vector3d& at, Range each, std::string meaning) {
  Key& key = add(std::move(name), Type::kNumbers, &at, std::move(meaning));
  key.range = each;
  key.count = 3;
  key.read = [](const Key& row, const Config& table, std::byte* bytes) {
    if (row.required || table.has(row.name))
      member<Eigen::Vector3d>(bytes) = read_vector(table, row.name, row.range, row.unit);
  };
  key.written = [](const Key& row, const std::byte* bytes) {
    const Eigen::Vector3d& v = member<Eigen::Vector3d>(bytes);
    return fmt::format("[{:.12g}, {:.12g}, {:.12g}]", in_unit(v[0], row.unit),
                       in_unit(v[1], row.unit), in_unit(v[2], row.unit));
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
      member<std::optional<Eigen::Vector3d>>(bytes) =
          read_vector(table, row.name, row.range, row.unit);
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
