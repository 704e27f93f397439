#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/abaqus_reading.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// The constants of one temperature: `count` numbers, eight a line, then perhaps the temperature.
// More sets of lines must say the same: materials do not depend on temperature here.
std::vector<double> constants_of(const Reading& reading, const Card& card, size_t count) {
  const size_t lines = (count + 7) / 8;
  if (card.size() == 0 || card.size() % lines != 0) {
    reading.source.fail(card.spot(), fmt::format("{}: found {} data lines, expected {}",
                                                 card.keyword().name, card.size(), lines));
  }
  std::vector<double> first;
  for (size_t begin = 0; begin < card.size(); begin += lines) {
    std::vector<double> values;
    for (size_t i = 0; i < lines; ++i) {
      const Fields fields = card.line(begin + i, reading.source);
      const size_t wanted = std::min<size_t>(8, count - 8 * i);
      for (size_t k = 0; k < wanted; ++k) values.push_back(fields.number(k, "material constant"));
    }
    if (begin == 0) first = values;
    if (values != first) {
      reading.source.fail(card.spot(), fmt::format("{}: constants that depend on the temperature "
                                                   "are not supported, expected one set",
                                                   card.keyword().name));
    }
  }
  return first;
}

// Abaqus' upper triangle goes column by column through stresses 11 22 33 12 13 23; ours row by row
// through 11 22 33 12 23 31.
std::vector<double> upper_triangle(const std::vector<double>& columns) {
  constexpr std::array<int, 6> kOurs = {0, 1, 2, 3, 5, 4};  // place of Abaqus' component with us
  Eigen::Matrix<double, 6, 6> C;
  size_t next = 0;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i <= j; ++i) {
      const int a = kOurs[static_cast<size_t>(i)], b = kOurs[static_cast<size_t>(j)];
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

void read_elastic(Reading* reading, const Card& card, Material* material) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"TYPE"}, reading->source, reading->ignore);
  const std::string type = keyword.choice("TYPE", "ISOTROPIC");
  using Kind = Material::Kind;
  if (type == "ISO" || type == "ISOTROPIC") {
    material->kind = Kind::kIsotropic;
    material->constants = constants_of(*reading, card, 2);
  } else if (type == "ENGINEERINGCONSTANTS") {
    material->kind = Kind::kOrthotropic;
    material->constants = constants_of(*reading, card, 9);
  } else if (type == "ORTHO" || type == "ORTHOTROPIC") {
    material->kind = Kind::kAnisotropic;
    material->constants = upper_triangle(orthotropic_columns(constants_of(*reading, card, 9)));
  } else if (type == "ANISO" || type == "ANISOTROPIC") {
    material->kind = Kind::kAnisotropic;
    material->constants = upper_triangle(constants_of(*reading, card, 21));
  } else {
    reading->source.fail(card.spot(), fmt::format("*ELASTIC: found TYPE={}, expected ISOTROPIC, "
                                                  "ENGINEERING CONSTANTS, ORTHOTROPIC or "
                                                  "ANISOTROPIC",
                                                  *keyword.find("TYPE")));
  }
}

// ZERO does not matter: strains are constant * (temperature - initial temperature).
void read_expansion(Reading* reading, const Card& card, Material* material) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"TYPE", "ZERO"}, reading->source, reading->ignore);
  const std::string type = keyword.choice("TYPE", "ISO");
  if (type == "ISO" || type == "ISOTROPIC") {
    material->expansion = constants_of(*reading, card, 1);
  } else if (type == "ORTHO" || type == "ORTHOTROPIC") {
    material->expansion = constants_of(*reading, card, 3);
  } else {
    reading->source.fail(
        card.spot(),
        fmt::format("*EXPANSION: found TYPE={}, expected ISO or ORTHO", *keyword.find("TYPE")));
  }
}

}  // namespace

void read_materials(Reading* reading) {
  Material* material = nullptr;
  for_each_card(
      *reading, {"MATERIAL", "ELASTIC", "DENSITY", "EXPANSION"}, [&](size_t use, const Card& card) {
        const Keyword& keyword = card.keyword();
        if (keyword.key == "ELASTIC") return read_elastic(reading, card, material);
        if (keyword.key == "EXPANSION") return read_expansion(reading, card, material);
        if (keyword.key == "DENSITY") {
          keyword.allow({}, reading->source, reading->ignore);
          material->density = constants_of(*reading, card, 1).front();
          return;
        }
        if (use != reading->model->main_use()) {
          reading->source.fail(card.spot(), "found *MATERIAL inside a part, expected it outside");
        }
        keyword.allow({"NAME"}, reading->source, reading->ignore);
        const std::string& name = keyword.required("NAME", reading->source);
        if (!reading->material_names.emplace(folded(name), name).second) {
          reading->source.fail(card.spot(), fmt::format("found a second material {}", name));
        }
        material = &reading->deck->materials[name];
        material->name = name;
        material->where = reading->source.where(card.spot());
      });
}

}  // namespace clatter::mesh::deck::abaqus
