// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of springs.
#include <fmt/format.h>

#include <bit>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

void refuse_damping(const Card& card, size_t i) {
  if (card.number_or(i, "GE", 0.0) != 0.0) {
    card.fail(i, "damping of springs (GE) is not supported, expected 0");
  }
}

// Both ends from field i on: G1, C1, G2, C2; an end without a grid is the ground.
RawSpring ends_of(const Card& card, size_t i) {
  RawSpring spring;
  spring.origin = card.origin();
  card.id(0, "EID");
  for (size_t end = 0; end < 2; ++end, i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    const DofMask dof = card.components(i + 1, "C");
    if (std::popcount(dof) != 1) card.fail_expected(i + 1, "C", "one digit");
    spring.ends.push_back({card.id(i, "G"), std::countr_zero(dof)});
  }
  if (spring.ends.empty()) card.fail_expected(i - 4, "G1", "a grid");
  return spring;
}

void check_stiffness(const Card& card, size_t i, double stiffness) {
  if (!(stiffness > 0.0)) card.fail_expected(i, "K", "a stiffness above 0");
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
  spring.stiffness = card.number(1, "K");
  check_stiffness(card, 1, spring.stiffness);
  refuse_damping(card, 6);
  raw.springs.push_back(std::move(spring));
}

void read_pelas(const Card& card, RawDeck& raw) {
  for (const size_t i : {size_t{0}, size_t{4}}) {
    if (i > 0 && card.blank_from(i)) break;
    const int32_t property = card.id(i, "PID");
    const double stiffness = card.number(i + 1, "K");
    check_stiffness(card, i + 1, stiffness);
    refuse_damping(card, i + 2);
    if (!raw.spring_stiffness.emplace(property, stiffness).second) {
      card.fail(i, fmt::format("found a second PELAS {}", property));
    }
  }
}

}  // namespace clatter::mesh::deck::nastran
