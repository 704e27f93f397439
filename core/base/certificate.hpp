// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Certificates: what was proved of an artefact, as a struct of numbers whose one list of fields
// writes, reads, prints and documents it.
//
//   struct SkinCertificate {
//     double area_m2 = 0.0;             // in every file
//     std::optional<double> closure{};  // absent where it does not apply
//     static const std::vector<CertificateField<SkinCertificate>>& fields();
//     bool operator==(const SkinCertificate&) const = default;
//   };
//
// The numbers are attributes of group `certificate`; docs/formats.md has the table of each list,
// docs/certificates.md that of the judgements.
#include <concepts>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/judgement.hpp"

namespace clatter {

/// Numbers by name.
using CertificateNumbers = std::map<std::string, double>;

/// One number of a certificate C, or a family of numbers.
template <class C>
struct CertificateField {
  /// The attribute's name. A family ends with a name in angle brackets: its numbers are named by
  /// what replaces it, "block" for periodicity_block of `periodicity_<body>`, and a family
  /// `<other>` holds all names that no other field has. Families are last in the list.
  const char* name;
  std::variant<double C::*, std::optional<double> C::*, CertificateNumbers C::*> member;
  const char* unit;     // "" for counts, ratios, and 0 or 1
  const char* meaning;  // one line
  Judgement judgement{};

  /// Calls `use` with the member of `certificate`.
  template <class Self, class Use>
  void visit(Self& certificate, const Use& use) const {
    std::visit([&](auto at) { use(certificate.*at); }, member);
  }
};

/// A struct with a list of fields.
template <class C>
concept Certified = requires {
  { C::fields() } -> std::same_as<const std::vector<CertificateField<C>>&>;
};

/// Adds what a field of this name holds.
void put_field(const std::string& name, double value, CertificateNumbers& numbers);
void put_field(const std::string& name, const std::optional<double>& value,
               CertificateNumbers& numbers);
void put_field(const std::string& name, const CertificateNumbers& family,
               CertificateNumbers& numbers);

/// Moves what belongs to a field of this name from `numbers` to it; InputError "found no ..." when
/// there is none and the field is in every file.
void take_field(const std::string& name, double& value, CertificateNumbers& numbers);
void take_field(const std::string& name, std::optional<double>& value, CertificateNumbers& numbers);
void take_field(const std::string& name, CertificateNumbers& family, CertificateNumbers& numbers);

/// Writes the numbers as attributes of group `certificate`, in alphabetical order.
void write_certificate_numbers(H5File& file, const CertificateNumbers& numbers);
/// All attributes of the group; none when it is absent. InputError for one that is no number.
CertificateNumbers read_certificate_numbers(const H5File& file);

/// Writes the limits of the judged numbers as attributes of groups `judged/good`, `judged/refused`.
void write_judgements(H5File& file, const std::vector<Judged>& numbers);

/// A row of the table in docs/formats.md, with | escaped; "" for the family `<other>`.
std::string certificate_row(const std::string& name, const std::string& unit,
                            const std::string& meaning);

/// The numbers that are present, by name.
template <Certified C>
CertificateNumbers certificate_numbers(const C& certificate) {
  CertificateNumbers numbers;
  for (const CertificateField<C>& field : C::fields())
    field.visit(certificate, [&](const auto& value) { put_field(field.name, value, numbers); });
  return numbers;
}

/// The numbers that are present and have a judgement.
template <Certified C>
std::vector<Judged> judged_numbers(const C& certificate) {
  std::vector<Judged> all;
  for (const CertificateField<C>& field : C::fields()) {
    if (!field.judgement.judges()) continue;
    CertificateNumbers numbers;
    field.visit(certificate, [&](const auto& value) { put_field(field.name, value, numbers); });
    for (const auto& [name, value] : numbers) all.push_back({name, value, field.judgement});
  }
  return all;
}

/// The judgement of the field of this name.
template <Certified C>
Judgement judgement_of(std::string_view name) {
  for (const CertificateField<C>& field : C::fields())
    if (field.name == name) return field.judgement;
  throw std::logic_error("no certificate has the field " + std::string(name));
}

/// Writes the numbers that are present and their judgements.
template <Certified C>
void store_certificate(H5File& file, const C& certificate) {
  write_certificate_numbers(file, certificate_numbers(certificate));
  write_judgements(file, judged_numbers(certificate));
}

/// The same, with warnings of the numbers that are not good.
/// @throws NumericsError for those that are refused
template <Certified C>
void write_certificate(H5File& file, const C& certificate) {
  require_trust(file.path().string(), judged_numbers(certificate));
  store_certificate(file, certificate);
}

/// The certificate of a file. Names that no field has are ignored; optional numbers that the file
/// lacks are absent. InputError when it lacks one that is in every file.
template <Certified C>
C read_certificate(const H5File& file) {
  CertificateNumbers numbers = read_certificate_numbers(file);
  C certificate;
  with_context(file.path().string() + ": certificate", [&] {
    for (const CertificateField<C>& field : C::fields())
      field.visit(certificate, [&](auto& value) { take_field(field.name, value, numbers); });
  });
  return certificate;
}

/// A row of the table in docs/certificates.md.
std::string judgement_row(const std::string& name, const Judgement& judgement);

/// The judgements of the fields, as in docs/certificates.md.
template <Certified C>
std::string judgement_table() {
  std::string table = "| figure | good | refused | else |\n|---|---|---|---|\n";
  for (const CertificateField<C>& field : C::fields())
    if (field.judgement.judges()) table += judgement_row(field.name, field.judgement);
  return table;
}

/// The table of the fields, as in docs/formats.md.
template <Certified C>
std::string certificate_table() {
  std::string table = "| `certificate` | unit | content |\n|---|---|---|\n";
  for (const CertificateField<C>& field : C::fields())
    table += certificate_row(field.name, field.unit, field.meaning);
  return table;
}

}  // namespace clatter
