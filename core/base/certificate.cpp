// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/certificate.hpp"

#include <fmt/format.h>

namespace clatter {
namespace {

/// What all names of a family begin with.
std::string beginning_of(const std::string& family) { return family.substr(0, family.find('<')); }

}  // namespace

void put_field(const std::string& name, double value, CertificateNumbers& numbers) {
  numbers.emplace(name, value);
}

void put_field(const std::string& name, const std::optional<double>& value,
               CertificateNumbers& numbers) {
  if (value) numbers.emplace(name, *value);
}

void put_field(const std::string& name, const CertificateNumbers& family,
               CertificateNumbers& numbers) {
  for (const auto& [member, value] : family) numbers.emplace(beginning_of(name) + member, value);
}

void take_field(const std::string& name, double& value, CertificateNumbers& numbers) {
  const auto found = numbers.extract(name);
  if (found.empty()) throw InputError(fmt::format("found no {}, expected a number", name));
  value = found.mapped();
}

void take_field(const std::string& name, std::optional<double>& value,
                CertificateNumbers& numbers) {
  const auto found = numbers.extract(name);
  value = found.empty() ? std::nullopt : std::optional(found.mapped());
}

void take_field(const std::string& name, CertificateNumbers& family, CertificateNumbers& numbers) {
  const std::string beginning = beginning_of(name);
  std::erase_if(numbers, [&](const auto& number) {
    if (!number.first.starts_with(beginning)) return false;
    family.emplace(number.first.substr(beginning.size()), number.second);
    return true;
  });
}

void write_certificate_numbers(H5File& file, const CertificateNumbers& numbers) {
  for (const auto& [name, value] : numbers) file.set("certificate", name, value);
}

void write_judgements(H5File& file, const std::vector<Judged>& numbers) {
  for (const Judged& number : numbers) {
    file.set("judged/good", number.name, number.judgement.good);
    file.set("judged/refused", number.name, number.judgement.refused);
  }
}

CertificateNumbers read_certificate_numbers(const H5File& file) {
  CertificateNumbers numbers;
  if (!file.has("certificate")) return numbers;
  for (const std::string& name : file.attributes("certificate"))
    numbers[name] = file.get_double("certificate", name);
  return numbers;
}

std::string certificate_row(const std::string& name, const std::string& unit,
                            const std::string& meaning) {
  if (name.starts_with('<')) return "";
  std::string text;
  for (const char letter : meaning)
    text += letter == '|' ? std::string("\\|") : std::string{letter};
  return fmt::format("| `{}` | {}{}| {} |\n", name, unit, unit.empty() ? "" : " ", text);
}

std::string judgement_row(const std::string& name, const Judgement& judgement) {
  return fmt::format("| `{}` | {} | {} | {} |\n", name, judgement.good_text(),
                     judgement.refused_text(), judgement.why);
}

}  // namespace clatter
