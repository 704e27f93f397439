// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "mesh/deck/abaqus/damping.hpp"
#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// The uniform initial temperature of all nodes; none if the deck has none or several.
std::optional<double> initial_temperature(const Model& model) {
  std::optional<double> found;
  bool one = true;
  for (const Card& card : model.numbering.uses()[model.numbering.main_use()].scope->cards) {
    if (card.keyword().key != "INITIALCONDITIONS" ||
        card.keyword().choice("TYPE", "") != "TEMPERATURE")
      continue;
    for (size_t i = 0; i < card.size(); ++i) {
      const auto value = to_number(card.line(i, model.source).text(1));
      one = one && value && (!found || *found == *value);
      if (value) found = value;
    }
  }
  return one ? found : std::nullopt;
}

const Card* first_card(const Model& model, std::string_view key) {
  for (const Card& card : model.numbering.uses()[model.numbering.main_use()].scope->cards) {
    if (card.keyword().key == key) return &card;
  }
  return nullptr;
}

using RowsByTemperature =
    std::vector<std::pair<double, std::vector<double>>>;  // by temperature, ascending

// Interpolates between rows, constant beyond the ends, as CalculiX does.
std::vector<double> interpolated(const RowsByTemperature& rows, double temperature) {
  if (temperature <= rows.front().first) return rows.front().second;
  if (temperature >= rows.back().first) return rows.back().second;
  size_t i = 1;
  while (rows[i].first < temperature) ++i;
  const double t = (temperature - rows[i - 1].first) / (rows[i].first - rows[i - 1].first);
  std::vector<double> out = rows[i].second;
  for (size_t k = 0; k < out.size(); ++k) {
    out[k] = (1.0 - t) * rows[i - 1].second[k] + t * out[k];
  }
  return out;
}

// Temperature-dependent constants are evaluated at the initial temperature if no step changes it.
std::vector<double> at_initial_temperature(Model& model, const Card& card,
                                           const RowsByTemperature& rows) {
  for (size_t i = 1; i < rows.size(); ++i) {
    if (!(rows[i].first > rows[i - 1].first)) {
      model.source.fail(card.origin(),
                        fmt::format("{}: found temperature {} after {}, expected "
                                    "ascending ones",
                                    card.keyword().name, rows[i].first, rows[i - 1].first));
    }
  }
  const auto temperature = initial_temperature(model);
  if (!temperature) {
    model.source.fail(card.origin(),
                      fmt::format("{}: constants that depend on the temperature need one initial "
                                  "temperature of all nodes (*INITIAL CONDITIONS), found none",
                                  card.keyword().name));
  }
  if (const Card* heat = first_card(model, "TEMPERATURE")) {
    model.source.fail(
        card.origin(),
        fmt::format("{}: constants that depend on the temperature are not supported in steps that "
                    "change it ({}), expected one set",
                    card.keyword().name, model.source.where(heat->origin())));
  }
  model.deck.notes.push_back(fmt::format("{}: {} is taken at the initial temperature {}",
                                         model.source.where(card.origin()), card.keyword().name,
                                         *temperature));
  return interpolated(rows, *temperature);
}

// `count` numbers, eight per line, then optionally their temperature; more sets of lines for other
// temperatures.
std::vector<double> constants_of(Model& model, const Card& card, size_t count) {
  const size_t lines = (count + 7) / 8;
  if (card.size() == 0 || card.size() % lines != 0) {
    model.source.fail(card.origin(), fmt::format("{}: found {} data lines, expected {}",
                                                 card.keyword().name, card.size(), lines));
  }
  RowsByTemperature rows;
  for (size_t begin = 0; begin < card.size(); begin += lines) {
    std::vector<double> values;
    double temperature = 0.0;
    for (size_t i = 0; i < lines; ++i) {
      const Fields fields = card.line(begin + i, model.source);
      const size_t wanted = std::min<size_t>(8, count - 8 * i);
      for (size_t k = 0; k < wanted; ++k) values.push_back(fields.number(k, "material constant"));
      temperature = fields.number_or(wanted, "temperature", 0.0);
    }
    rows.emplace_back(temperature, std::move(values));
  }
  const bool same = std::all_of(rows.begin(), rows.end(),
                                [&](const auto& row) { return row.second == rows.front().second; });
  return same ? rows.front().second : at_initial_temperature(model, card, rows);
}

// Abaqus' upper triangle is by columns with stresses 11 22 33 12 13 23; ours by rows with 11 22 33
// 12 23 31.
std::vector<double> upper_triangle(const std::vector<double>& columns) {
  constexpr std::array<int, 6> kOurs = {0, 1, 2, 3, 5, 4};  // our index of Abaqus' component
  Eigen::Matrix<double, 6, 6> C;
  size_t next = 0;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i <= j; ++i) {
      const int a = kOurs[i], b = kOurs[j];
      C(a, b) = C(b, a) = columns[next++];
    }
  }
  std::vector<double> rows;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) rows.push_back(C(i, j));
  }
  return rows;
}

// D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323 in the order of 21 columns.
std::vector<double> orthotropic_columns(const std::vector<double>& d) {
  std::vector<double> columns(21, 0.0);
  std::copy(d.begin(), d.begin() + 6, columns.begin());
  columns[9] = d[6];
  columns[14] = d[7];
  columns[20] = d[8];
  return columns;
}

void read_elastic(Model& model, const Card& card, Material* material) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"TYPE"}, model.source, model.ignore);
  const std::string type = keyword.choice("TYPE", "ISOTROPIC");
  using Kind = Material::Kind;
  if (type == "ISO" || type == "ISOTROPIC") {
    material->kind = Kind::kIsotropic;
    material->constants = constants_of(model, card, 2);
  } else if (type == "ENGINEERINGCONSTANTS") {
    material->kind = Kind::kOrthotropic;
    material->constants = constants_of(model, card, 9);
  } else if (type == "ORTHO" || type == "ORTHOTROPIC") {
    material->kind = Kind::kAnisotropic;
    material->constants = upper_triangle(orthotropic_columns(constants_of(model, card, 9)));
  } else if (type == "ANISO" || type == "ANISOTROPIC") {
    material->kind = Kind::kAnisotropic;
    material->constants = upper_triangle(constants_of(model, card, 21));
  } else if (type == "LAMINA") {
    // E1, E2, nu12, G12, G13, G23; E3, nu13 and nu23 have no part in a sheet.
    const std::vector<double> given = constants_of(model, card, 6);
    material->kind = Kind::kOrthotropic;
    material->of_sheets = true;
    material->constants = {given[0], given[1], given[1], given[2], 0.0,
                           0.0,      given[3], given[4], given[5]};
  } else {
    model.source.fail(card.origin(), fmt::format("*ELASTIC: found TYPE={}, expected ISOTROPIC, "
                                                 "ENGINEERING CONSTANTS, ORTHOTROPIC, ANISOTROPIC "
                                                 "or LAMINA",
                                                 *keyword.find("TYPE")));
  }
}

// ZERO does not matter: strains are constant * (temperature - initial temperature).
void read_expansion(Model& model, const Card& card, Material* material) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"TYPE", "ZERO"}, model.source, model.ignore);
  const std::string type = keyword.choice("TYPE", "ISO");
  if (type == "ISO" || type == "ISOTROPIC") {
    material->expansion = constants_of(model, card, 1);
  } else if (type == "ORTHO" || type == "ORTHOTROPIC") {
    material->expansion = constants_of(model, card, 3);
  } else {
    model.source.fail(card.origin(), fmt::format("*EXPANSION: found TYPE={}, expected ISO or ORTHO",
                                                 *keyword.find("TYPE")));
  }
}

// D = ALPHA M + BETA K, and STRUCTURAL, the loss factor; other kinds are of steps that are not
// read.
void read_damping(Model& model, const Card& card, Material* material) {
  const Keyword& keyword = card.keyword();
  constexpr int64_t kNoMore = 0;  // it is counted
  model.refusals.contents().pass("keyword", keyword.name, model.source, card.origin(),
                                 "damping, offered to the recipe", kNoMore);
  if (keyword.has("STRUCTURAL") && keyword.choice("STRUCTURAL", "") != "TABULAR")
    material->loss_factor =
        Fields(*keyword.find("STRUCTURAL"), model.source, card.origin()).number(0, "STRUCTURAL");
  const auto found = rayleigh_of(card, model.source);
  if (!found) return;
  material->mass_damping = found->mass;
  material->stiffness_damping = found->stiffness;
}

// *ELASTIC, *DENSITY, *EXPANSION or *DAMPING of `material`, none if *MATERIAL itself was refused. A
// material with a refused part is dropped.
void read_part(Model& model, const Card& card, Material* material) {
  if (material == nullptr) throw FollowUp();
  const Keyword& keyword = card.keyword();
  try {
    if (keyword.key == "ELASTIC") return read_elastic(model, card, material);
    if (keyword.key == "EXPANSION") return read_expansion(model, card, material);
    if (keyword.key == "DAMPING") return read_damping(model, card, material);
    keyword.allow({}, model.source, model.ignore);
    material->density = constants_of(model, card, 1).front();
  } catch (const InputError&) {
    model.refusals.lose(folded(material->name));
    throw;
  }
}

}  // namespace

void build_materials(Model& model) {
  Material* material = nullptr;
  for_each_card(
      model, {"MATERIAL", "ELASTIC", "DENSITY", "EXPANSION", "DAMPING"},
      [&](size_t use, const Card& card) {
        const Keyword& keyword = card.keyword();
        if (keyword.key != "MATERIAL") return read_part(model, card, material);
        material = nullptr;
        if (use != model.numbering.main_use()) {
          model.source.fail(card.origin(), "found *MATERIAL inside a part, expected it outside");
        }
        keyword.allow({"NAME", "RTOL", "SRATEFACTOR"}, model.source, model.ignore);
        const std::string& name = keyword.required("NAME", model.source);
        if (!model.material_names.emplace(folded(name), name).second) {
          model.source.fail(card.origin(), fmt::format("found a second material {}", name));
        }
        material = &model.deck.materials[name];
        material->name = name;
        material->where = model.source.where(card.origin());
      });
}

}  // namespace clatter::mesh::deck::abaqus
