// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of springs, scalar masses and bushes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

bool is_mass(const Card& card) { return card.name().starts_with("CMASS"); }

RawSpring without_ends(const Card& card) {
  RawSpring spring;
  spring.origin = card.origin();
  spring.is_mass = is_mass(card);
  card.id(0, "EID");
  return spring;
}

// Both ends from field i on: G1, C1, G2, C2; an end without a grid is the ground. Scalar points
// have no component.
RawSpring ends_of(const Card& card, size_t i) {
  RawSpring spring = without_ends(card);
  for (size_t end = 0; end < 2; ++end, i += 2) {
    const bool grounded = card.blank(i) || card.text(i) == "0";
    if (grounded && (card.blank(i + 1) || card.text(i + 1) == "0")) continue;
    const DofMask dof = card.components_or_none(i + 1, "C");
    if (std::popcount(dof) > 1) card.fail_expected(i + 1, "C", "one digit");
    spring.ends.push_back({card.id(i, "G"), dof == 0 ? kScalar : std::countr_zero(dof)});
  }
  if (spring.ends.empty()) card.fail_expected(i - 4, "G1", "a grid");
  return spring;
}

// S1 and S2.
RawSpring points_of(const Card& card) {
  RawSpring spring = without_ends(card);
  for (const size_t i : {size_t{2}, size_t{3}})
    if (!card.blank(i) && card.text(i) != "0") spring.ends.push_back({card.id(i, "S"), kScalar});
  if (spring.ends.empty()) card.fail_expected(2, "S1", "a scalar point");
  card.at_most(4);
  return spring;
}

// EID PID GA GB, the orientation X1 X2 X3 or GO, CID.
RawBush without_offset(const Card& card) {
  RawBush bush;
  bush.origin = card.origin();
  bush.id = card.id(0, "EID");
  bush.property = card.id_or(1, "PID", bush.id);
  bush.grids = {card.id(2, "GA"), card.id_or(3, "GB", 0)};
  if (card.is_integer(4) && card.blank(5) && card.blank(6)) {
    bush.orientation_grid = card.id(4, "GO");
  } else {
    for (size_t k = 0; k < 3; ++k) bush.orientation[k] = card.number_or(4 + k, "X", 0.0);
  }
  bush.system = card.integer_or(7, "CID", -1);
  return bush;
}

double value_of(const Card& card, size_t i, bool mass) {
  const double value = card.number(i, mass ? "M" : "K");
  if (!(value > 0.0)) {
    card.fail_expected(i, mass ? "M" : "K", mass ? "a mass above 0" : "a stiffness above 0");
  }
  return value;
}

double loss_factor_of(const Card& card, size_t i) {
  const double value = card.number_or(i, "GE", 0.0);
  if (!(value >= 0.0)) card.fail_expected(i, "GE", "a loss factor of 0 or more");
  return value;
}

// Rows of K and GE count; those of other damping, stress recovery (RCV) and temperature (T) change
// no stiffness.
void check_bush_row(const Card& card, size_t i, std::string_view row) {
  constexpr std::array<std::string_view, 6> kRows = {"K", "B", "GE", "M", "RCV", "T"};
  if (row == "KMAG" || row == "ANGLE")
    card.fail(i, fmt::format("{} is not supported, expected K = KMAG cos(ANGLE) and GE = "
                             "tan(ANGLE)",
                             row));
  if (std::ranges::find(kRows, row) == kRows.end())
    card.fail_expected(i, "field 3", "K, B, GE, M, RCV or T");
  if (row == "M" && !card.blank_from(i + 1))
    card.fail(i, "the mass of a bush (M) is not supported, expected a CONM2");
}

}  // namespace

void read_celas1(const Card& card, RawDeck& raw) {
  RawSpring spring = ends_of(card, 2);
  spring.property = card.id_or(1, "PID", card.id(0, "EID"));
  card.at_most(6);
  raw.springs.push_back(std::move(spring));
}

void read_celas2(const Card& card, RawDeck& raw) {
  RawSpring spring = ends_of(card, 2);
  spring.value = value_of(card, 1, spring.is_mass);
  if (spring.is_mass) {
    card.at_most(6);
  } else {
    spring.loss_factor = loss_factor_of(card, 6);
  }
  raw.springs.push_back(std::move(spring));
}

void read_celas3(const Card& card, RawDeck& raw) {
  RawSpring spring = points_of(card);
  spring.property = card.id_or(1, "PID", card.id(0, "EID"));
  raw.springs.push_back(std::move(spring));
}

void read_celas4(const Card& card, RawDeck& raw) {
  RawSpring spring = points_of(card);
  spring.value = value_of(card, 1, spring.is_mass);
  raw.springs.push_back(std::move(spring));
}

void read_pelas(const Card& card, RawDeck& raw) {
  for (const size_t i : {size_t{0}, size_t{4}}) {
    if (i > 0 && card.blank_from(i)) break;
    const int32_t property = card.id(i, "PID");
    const RawSpringProperty spring{value_of(card, i + 1, false), loss_factor_of(card, i + 2)};
    if (!raw.spring_properties.emplace(property, spring).second) {
      card.fail(i, fmt::format("found a second PELAS {}", property));
    }
  }
}

void read_pmass(const Card& card, RawDeck& raw) {
  for (size_t i = 0; i < 8; i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    const int32_t property = card.id(i, "PID");
    if (!raw.scalar_masses.emplace(property, value_of(card, i + 1, true)).second) {
      card.fail(i, fmt::format("found a second PMASS {}", property));
    }
  }
}

void read_spoint(const Card& card, RawDeck& raw) {
  for (const IdRange& range : card.ids(0, "ID")) {
    constexpr int32_t kMostPoints = 1'000'000;
    if (range.last - range.first >= kMostPoints)
      card.fail(0, fmt::format("found {} THRU {}, expected at most {} scalar points", range.first,
                               range.last, kMostPoints));
    for (int64_t id = range.first; id <= range.last; id += range.step)
      raw.scalar_points.insert(static_cast<int32_t>(id));
  }
}

void read_cbush(const Card& card, RawDeck& raw) {
  RawBush bush = without_offset(card);
  bush.share = card.number_or(8, "S", 0.5);
  bush.offset_system = card.integer_or(9, "OCID", -1);
  for (size_t k = 0; k < 3; ++k) bush.offset[k] = card.number_or(10 + k, "S", 0.0);
  card.at_most(13);
  raw.bushes.push_back(bush);
}

void read_cgap(const Card& card, RawDeck& raw) {
  RawBush gap = without_offset(card);
  gap.is_gap = true;
  card.id(3, "GB");
  card.at_most(8);
  raw.bushes.push_back(gap);
}

// PID U0 F0 KA KB KT MU1: of a linear solution counts the stiffness of the initial state.
void read_pgap(const Card& card, RawDeck& raw) {
  constexpr double kOpen = 1e-14;  // of KA: the default of KB
  const int32_t id = card.id(0, "PID");
  const auto stiffness = [&](size_t i, const char* what, double otherwise) {
    const double value = card.number_or(i, what, otherwise);
    if (!(value >= 0.0)) card.fail_expected(i, what, "a stiffness of 0 or more");
    return value;
  };
  RawGapProperty gap;
  gap.origin = card.origin();
  const double closed = stiffness(3, "KA", 0.0);
  if (!(closed > 0.0)) card.fail_expected(3, "KA", "a stiffness above 0");
  const double open = stiffness(4, "KB", 0.0);
  const double across =
      stiffness(5, "KT", card.blank(5) ? card.number_or(6, "MU1", 0.0) * closed : 0.0);
  gap.is_open = card.number_or(1, "U0", 0.0) > 0.0;
  gap.along = !gap.is_open ? closed : open > 0.0 ? open : kOpen * closed;
  gap.across = gap.is_open ? 0.0 : across;
  if (!raw.gap_properties.emplace(id, gap).second)
    card.fail(0, fmt::format("found a second PGAP {}", id));
}

// Rows of a word and up to six numbers.
void read_pbush(const Card& card, RawDeck& raw) {
  const int32_t id = card.id(0, "PID");
  RawBushProperty property;
  property.origin = card.origin();
  std::string_view row = "K";
  for (size_t line = 0; line < card.size(); line += 8) {
    if (line > 0 && !card.blank(line)) card.fail_expected(line, "field 2", "a blank field");
    const std::string_view word = card.text(line + 1);
    if (!word.empty()) row = word;
    check_bush_row(card, line + 1, row);
    for (size_t i = line + 2; i < line + 8; ++i) {
      if (row == "GE") property.loss_factors[i - line - 2] = loss_factor_of(card, i);
      if (row != "K" || card.blank(i)) continue;
      if (card.text(i) == "RIGID")
        card.fail(i, "RIGID is not supported, expected a stiffness, or an RBE2 for the CBUSH");
      property.stiffness[i - line - 2] = card.number(i, "K");
      if (!(property.stiffness[i - line - 2] >= 0.0))
        card.fail_expected(i, "K", "a stiffness of 0 or more");
    }
    if (word == "B") raw.count_damping("PBUSH B", card.origin());
  }
  if (!raw.bush_properties.emplace(id, property).second) {
    card.fail(0, fmt::format("found a second PBUSH {}", id));
  }
}

}  // namespace clatter::mesh::deck::nastran
