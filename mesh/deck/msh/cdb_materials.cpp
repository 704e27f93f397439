// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/cdb_materials.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "mesh/deck/field_text.hpp"

namespace clatter::mesh {
namespace {

double number_at(const TextLines& line, const std::vector<std::string>& fields, size_t i) {
  const auto value = i < fields.size() ? deck::to_number(fields[i]) : std::nullopt;
  if (!value) line.fail(fmt::format("found no number in field {} of {}", i + 1, fields[0]));
  return *value;
}

int material_at(const TextLines& line, const std::vector<std::string>& fields, size_t i) {
  const auto value = i < fields.size() ? deck::to_integer(fields[i]) : std::nullopt;
  if (!value) line.fail(fmt::format("found no number of a material in field {}", i + 1));
  return *value;
}

}  // namespace

void CdbMaterials::read_mp(const TextLines& line, const std::vector<std::string>& fields) {
  if (fields.size() < 4) line.fail("MP: expected label, material, value");
  Value& value = values_[material_at(line, fields, 2)][deck::capitals(fields[1])];
  value = {number_at(line, fields, 3), false, line.where()};
  for (size_t i = 4; i < fields.size(); ++i)
    value.varies = value.varies || (!fields[i].empty() && number_at(line, fields, i) != 0.0);
}

void CdbMaterials::read_mpdata(const TextLines& line, const std::vector<std::string>& all) {
  std::vector<std::string> fields = all;
  if (fields.size() > 1 && fields[1].starts_with('R')) fields.erase(fields.begin() + 1);
  if (fields.size() < 6) line.fail("MPDATA: expected count, label, material, start, values");
  Value& value = values_[material_at(line, fields, 3)][deck::capitals(fields[2])];
  if (value.where.empty()) value = {number_at(line, fields, 5), false, line.where()};
  for (size_t i = 5; i < fields.size() && !fields[i].empty(); ++i)
    value.varies = value.varies || number_at(line, fields, i) != value.first;
}

double CdbMaterials::value(int number, const std::string& label, double fallback) const {
  const auto& all = values_.at(number);
  const auto found = all.find(label);
  if (found == all.end()) return fallback;
  if (found->second.varies)
    throw InputError(
        fmt::format("{}: {} of material {} depends on the temperature, expected one "
                    "value: write the one of the operating temperature",
                    found->second.where, label, number));
  return found->second.first;
}

deck::Material CdbMaterials::material(int number) const {
  deck::Material out;
  out.name = fmt::format("mat_{}", number);
  const auto& all = values_.at(number);
  out.where = all.begin()->second.where;
  const auto require = [&](const std::string& label) {
    if (!all.contains(label))
      throw InputError(fmt::format("{}: material {} has no {}", out.where, number, label));
    return value(number, label, 0.0);
  };
  if (all.contains("EY")) {
    out.kind = deck::Material::Kind::kOrthotropic;
    for (const char* label : {"EX", "EY", "EZ", "PRXY", "PRXZ", "PRYZ", "GXY", "GXZ", "GYZ"})
      out.constants.push_back(require(label));
  } else {
    out.constants = {require("EX"), all.contains("PRXY") ? value(number, "PRXY", 0.0)
                                                         : value(number, "NUXY", 0.3)};
  }
  out.density = value(number, "DENS", 0.0);
  if (all.contains("ALPX")) out.expansion = {value(number, "ALPX", 0.0)};
  out.mass_damping = value(number, "ALPD", 0.0);
  out.stiffness_damping = value(number, "BETD", 0.0);
  return out;
}

}  // namespace clatter::mesh
