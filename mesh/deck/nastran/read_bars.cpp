// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of bars, beams and rods, and of their sections.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <span>

#include "mesh/deck/bar_shapes.hpp"
#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

std::string name_of(const Card& card) {
  std::string name(card.name());
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return fmt::format("{}_{}", name, card.id(0, "EID"));
}

// X1 X2 X3 or G0 from field 4 on, and OFFT.
void read_orientation(const Card& card, RawBar& bar) {
  if (card.is_integer(4) && card.blank(5) && card.blank(6)) {
    bar.orientation_grid = card.id(4, "G0");
  } else if (!card.blank(4) || !card.blank(5) || !card.blank(6)) {
    bar.orientation = {card.number_or(4, "X1", 0.0), card.number_or(5, "X2", 0.0),
                       card.number_or(6, "X3", 0.0)};
  }
  if (card.blank(7) || !card.is_word(7)) return;
  const std::string_view how = card.text(7);
  if (how.size() != 3 || (how[0] != 'G' && how[0] != 'B') || how[1] != 'G' || how[2] != 'G')
    card.fail_expected(7, "OFFT", "GGG or BGG: offsets along the axes of the grids");
  bar.orientation_is_basic = how[0] == 'B';
}

void add(const Card& card, RawDeck& raw, int32_t id, RawBarProperty property) {
  property.card = card.name();
  property.origin = card.origin();
  if (!raw.bar_properties.emplace(id, std::move(property)).second)
    card.fail(0, fmt::format("found a second property {} of bars", id));
}

double not_negative(const Card& card, size_t i, const char* what, double otherwise = 0.0) {
  const double value = card.number_or(i, what, otherwise);
  if (!(value >= 0.0)) card.fail_expected(i, what, "0 or more");
  return value;
}

RawBarProperty rod(const Card& card, size_t material, double area, double J, double line_mass) {
  RawBarProperty property;
  property.material = card.id(material, "MID");
  property.sections = {{.area = area, .J = J, .line_mass = line_mass}};
  return property;
}

/// A shape of PBARL and PBEAML by its dimensions d.
struct Shape {
  std::string_view name;
  size_t dimensions;
  BeamSection (*section)(std::span<const double> d);
  std::array<double, 2> (*shear)(std::span<const double> d, double area);
};

std::array<double, 2> same(double k) { return {k, k}; }

// Shear factors: of ROD that of the printed results of a deck (ssll11a), of others as Nastran has
// them.
constexpr std::array kShapes = {
    Shape{"ROD", 1, [](std::span<const double> d) { return ring_section(d[0], 0.0); },
          [](std::span<const double>, double) { return same(6.0 / 7.0); }},
    Shape{"TUBE", 2, [](std::span<const double> d) { return ring_section(d[0], d[1]); },
          [](std::span<const double>, double) { return same(0.5); }},
    Shape{"TUBE2", 2, [](std::span<const double> d) { return ring_section(d[0], d[0] - d[1]); },
          [](std::span<const double>, double) { return same(0.5); }},
    Shape{"BAR", 2, [](std::span<const double> d) { return rectangle_section(d[1], d[0]); },
          [](std::span<const double>, double) { return same(5.0 / 6.0); }},
    Shape{"BOX", 4, [](std::span<const double> d) { return box_section(d[1], d[0], d[2], d[3]); },
          [](std::span<const double> d, double area) {
            return std::array{2.0 * d[1] * d[3] / area, 2.0 * d[0] * d[2] / area};
          }},
    Shape{"I", 6,
          [](std::span<const double> d) {
            return i_section({d[0], d[1], d[2], d[3], d[4], d[5]});
          },
          [](std::span<const double> d, double area) {
            return std::array{d[3] * (d[0] - 0.5 * (d[4] + d[5])) / area,
                              5.0 / 6.0 * (d[1] * d[4] + d[2] * d[5]) / area};
          }},
};

/// The dimensions from field i on and NSM after them; those that are blank are of `before`, if any.
std::vector<double> dimensions_at(const Card& card, size_t i, const Shape& shape,
                                  const std::vector<double>& before) {
  std::vector<double> out = before;
  out.resize(shape.dimensions + 1);
  for (size_t k = 0; k < shape.dimensions; ++k)
    if (!card.blank(i + k) || before.empty()) {
      out[k] = card.number(i + k, "DIM");
      if (!(out[k] > 0.0) && !(shape.name == "TUBE" && k == 1 && out[k] == 0.0))
        card.fail_expected(i + k, "DIM", "more than 0");
    }
  out.back() = not_negative(card, i + shape.dimensions, "NSM", out.back());
  return out;
}

BeamSection section_of(const Card& card, size_t i, const Shape& shape,
                       const std::vector<double>& dimensions) {
  BeamSection section = shape.section(std::span(dimensions).first(shape.dimensions));
  if (!(section.area > 0.0) || !(section.I1 > 0.0) || !(section.I2 > 0.0) || !(section.J > 0.0))
    card.fail_expected(i, "DIM1", "dimensions that leave an area");
  section.line_mass = dimensions.back();
  return section;
}

// PID MID GROUP TYPE, then dimensions and NSM; of a PBEAML also SO X dimensions NSM of other
// stations.
void read_shape(const Card& card, RawDeck& raw, bool stations) {
  RawBarProperty property;
  const int32_t id = card.id(0, "PID");
  property.material = card.id(1, "MID");
  const std::string_view type = card.text(3);
  const auto* const shape = std::ranges::find(kShapes, type, &Shape::name);
  if (shape == kShapes.end()) {
    std::vector<std::string_view> known;
    for (const Shape& one : kShapes) known.push_back(one.name);
    property.refusal = fmt::format(
        "found TYPE {}, expected one of {}; a {} with its A, I1, I2, J "
        "and K1, K2 replaces it",
        type, fmt::join(known, ", "), stations ? "PBEAM" : "PBAR");
    return add(card, raw, id, std::move(property));
  }
  size_t i = 8;
  const std::vector<double> a = dimensions_at(card, i, *shape, {});
  property.sections.push_back(section_of(card, i, *shape, a));
  const auto [k1, k2] =
      shape->shear(std::span(a).first(shape->dimensions), property.sections[0].area);
  property.shear_factors = {k1, k2};
  i += shape->dimensions + 1;
  std::map<size_t, double> at_fields;  // the field where each station begins: X/XB
  for (; stations && !card.blank_from(i); i += shape->dimensions + 3)
    at_fields[i] = card.number_or(i + 1, "X", 1.0);
  std::vector<double> b = a;
  for (const auto& [from, at] : at_fields)
    if (at == 1.0) b = dimensions_at(card, from + 2, *shape, a);
  for (const auto& [from, at] : at_fields) {
    std::vector<double> between(a.size());
    for (size_t k = 0; k < a.size(); ++k) between[k] = (1.0 - at) * a[k] + at * b[k];
    const auto d = at == 1.0 ? b : dimensions_at(card, from + 2, *shape, between);
    property.sections.push_back(section_of(card, from + 2, *shape, d));
    property.sections.back().at = at;
  }
  card.at_most(i);
  add(card, raw, id, std::move(property));
}

bool is_station(const Card& card, size_t line) {
  const std::string_view word = card.text(line);
  return word == "YES" || word == "YESA" || word == "NO";
}

/// Between the ends A and B, at a share of the length.
BeamSection mixed(const BeamSection& a, const BeamSection& b, double at) {
  BeamSection out;
  for (double BeamSection::*value : {&BeamSection::area, &BeamSection::I1, &BeamSection::I2,
                                     &BeamSection::I12, &BeamSection::J, &BeamSection::line_mass})
    out.*value = (1.0 - at) * a.*value + at * b.*value;
  return out;
}

/// A I1 I2 I12 J NSM from field i on; those that are blank are `before`'s.
BeamSection beam_section_at(const Card& card, size_t i, const BeamSection& before) {
  BeamSection section;
  section.area = not_negative(card, i, "A", before.area);
  section.I1 = not_negative(card, i + 1, "I1", before.I1);
  section.I2 = not_negative(card, i + 2, "I2", before.I2);
  section.I12 = card.number_or(i + 3, "I12", before.I12);
  section.J = not_negative(card, i + 4, "J", before.J);
  section.line_mass = not_negative(card, i + 5, "NSM", before.line_mass);
  return section;
}

}  // namespace

void read_cbar(const Card& card, RawDeck& raw) {
  RawBar bar;
  bar.name = name_of(card);
  bar.origin = card.origin();
  bar.id = card.id(0, "EID");
  bar.property = card.id_or(1, "PID", 0);
  bar.grids = {card.id(2, "GA"), card.id(3, "GB")};
  read_orientation(card, bar);
  for (size_t end = 0; end < 2; ++end) {
    bar.released[end] = card.components_or_none(8 + end, end == 0 ? "PA" : "PB");
    for (size_t k = 0; k < 3; ++k) bar.offset[end][k] = card.number_or(10 + 3 * end + k, "W", 0.0);
  }
  if (card.name() == "CBAR") card.at_most(16);  // of CBEAM warping follows, which has no effect
  raw.bars.push_back(std::move(bar));
}

void read_baror(const Card& card, RawDeck& raw) {
  RawBar bar;
  bar.origin = card.origin();
  bar.property = card.id_or(1, "PID", 0);
  read_orientation(card, bar);
  card.at_most(8);
  (card.name() == "BAROR" ? raw.bar_default : raw.beam_default) = std::move(bar);
}

void read_crod(const Card& card, RawDeck& raw) {
  RawBar bar;
  bar.name = name_of(card);
  bar.origin = card.origin();
  bar.property = card.id_or(1, "PID", card.id(0, "EID"));
  bar.grids = {card.id(2, "G1"), card.id(3, "G2")};
  card.at_most(4);
  raw.bars.push_back(std::move(bar));
}

// Its property has the negative of its number, which no other has.
void read_conrod(const Card& card, RawDeck& raw) {
  RawBar bar;
  bar.name = name_of(card);
  bar.origin = card.origin();
  bar.property = -card.id(0, "EID");
  bar.grids = {card.id(1, "G1"), card.id(2, "G2")};
  add(card, raw, bar.property,
      rod(card, 3, not_negative(card, 4, "A"), not_negative(card, 5, "J"),
          not_negative(card, 7, "NSM")));
  card.at_most(8);
  raw.bars.push_back(std::move(bar));
}

// PID MID A I1 I2 J NSM, eight stress points, K1 K2 I12.
void read_pbar(const Card& card, RawDeck& raw) {
  RawBarProperty property;
  property.material = card.id(1, "MID");
  BeamSection section;
  section.area = not_negative(card, 2, "A");
  section.I1 = not_negative(card, 3, "I1");
  section.I2 = not_negative(card, 4, "I2");
  section.J = not_negative(card, 5, "J");
  section.line_mass = not_negative(card, 6, "NSM");
  section.I12 = card.number_or(18, "I12", 0.0);
  property.sections = {section};
  const double K1 = not_negative(card, 16, "K1"), K2 = not_negative(card, 17, "K2");
  const bool askew = section.I12 != 0.0;  // K1 and K2 have no effect then
  if (!askew && (K1 > 0.0) != (K2 > 0.0))
    property.refusal = fmt::format("found K1 = {:g} and K2 = {:g}, expected both or none", K1, K2);
  if (!askew && K1 > 0.0) property.shear_factors = {K1, K2};
  card.at_most(19);
  add(card, raw, card.id(0, "PID"), std::move(property));
}

void read_pbarl(const Card& card, RawDeck& raw) { read_shape(card, raw, false); }
void read_pbeaml(const Card& card, RawDeck& raw) { read_shape(card, raw, true); }

// PID MID and the section at A with its stress points; lines of other stations, each with stress
// points after YES; shear factors and the like; masses and axes away from the shear centre.
void read_pbeam(const Card& card, RawDeck& raw) {
  RawBarProperty property;
  property.material = card.id(1, "MID");
  property.sections = {beam_section_at(card, 2, {})};
  size_t line = 8;
  if (!is_station(card, line)) line += 8;  // stress points at A
  std::map<size_t, double> stations;       // the field where each begins: X/XB
  while (is_station(card, line)) {
    stations[line] = card.number_or(line + 1, "X/XB", 1.0);
    line += card.text(line) == "YES" ? 16 : 8;
  }
  const BeamSection a = property.sections[0];
  BeamSection b = a;
  for (const auto& [from, at] : stations)
    if (at == 1.0) b = beam_section_at(card, from + 2, a);
  for (const auto& [from, at] : stations) {
    property.sections.push_back(at == 1.0 ? b : beam_section_at(card, from + 2, mixed(a, b, at)));
    property.sections.back().at = at;
  }
  std::ranges::sort(property.sections, {}, &BeamSection::at);
  const double K1 = not_negative(card, line, "K1", 1.0),
               K2 = not_negative(card, line + 1, "K2", 1.0);
  if ((K1 > 0.0) != (K2 > 0.0))
    property.refusal = fmt::format("found K1 = {:g} and K2 = {:g}, expected both or none", K1, K2);
  if (K1 > 0.0) property.shear_factors = {K1, K2};
  for (size_t i = line + 4; i < line + 16; ++i)
    if (i != line + 6 && i != line + 7 && card.number_or(i, "NSI, M or N", 0.0) != 0.0)
      property.refusal =
          "found NSI, M or N, expected none: the mass and the shear centre lie on the axis here";
  card.at_most(line + 16);
  add(card, raw, card.id(0, "PID"), std::move(property));
}

void read_prod(const Card& card, RawDeck& raw) {
  add(card, raw, card.id(0, "PID"),
      rod(card, 1, not_negative(card, 2, "A"), not_negative(card, 3, "J"),
          not_negative(card, 5, "NSM")));
  card.at_most(6);
}

// PID MID OD T NSM OD2.
void read_ptube(const Card& card, RawDeck& raw) {
  const double outer = 0.5 * card.number(2, "OD"), wall = card.number_or(3, "T", 0.0);
  const BeamSection section = ring_section(outer, wall > 0.0 ? outer - wall : 0.0);
  RawBarProperty property = rod(card, 1, section.area, section.J, not_negative(card, 4, "NSM"));
  if (!card.blank(5) && card.number(5, "OD2") != card.number(2, "OD"))
    property.refusal = "found OD2, expected a tube of one diameter";
  card.at_most(6);
  add(card, raw, card.id(0, "PID"), std::move(property));
}

}  // namespace clatter::mesh::deck::nastran
