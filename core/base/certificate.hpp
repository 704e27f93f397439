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
// The numbers are attributes of group `certificate`; docs/formats.md has the table of each list.
#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"

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

/// Writes the numbers that are present.
template <Certified C>
void write_certificate(H5File& file, const C& certificate) {
  write_certificate_numbers(file, certificate_numbers(certificate));
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

/// The table of the fields, as in docs/formats.md.
template <Certified C>
std::string certificate_table() {
  std::string table = "| `certificate` | unit | content |\n|---|---|---|\n";
  for (const CertificateField<C>& field : C::fields())
    table += certificate_row(field.name, field.unit, field.meaning);
  return table;
}

}  // namespace clatter
