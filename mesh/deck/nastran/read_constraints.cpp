// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of couplings, masses, supports and sets.
#include <fmt/format.h>

#include <bit>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

void add_sum(const Card& card, std::map<int32_t, SetSum>& sums) {
  const int32_t set = card.id(0, "SID");
  if (!sums.emplace(set, SetSum{card.origin(), card.ids(1, "set")}).second) {
    card.fail(0, fmt::format("found a second set {}", set));
  }
}

// UM of RBE3 selects the dependent DoFs; the equations do not depend on it. Their number must match
// the reference's.
size_t pass_um(const Card& card, size_t i, DofMask reference) {
  int count = 0;
  for (++i; i < card.size() && !card.is_word(i); ++i) {
    if (card.blank(i)) continue;
    card.id(i, "UM grid");
    count += std::popcount(card.components(++i, "UM components"));
  }
  if (count != std::popcount(reference)) {
    card.fail(i - 1, fmt::format("UM: found {} components, expected {} as in REFC", count,
                                 std::popcount(reference)));
  }
  return i;
}

void refuse_expansion(const Card& card, size_t i) {
  if (card.number_or(i, "ALPHA", 0.0) != 0.0) {
    card.fail(i, "thermal expansion of rigid elements (ALPHA) is not supported");
  }
}

}  // namespace

void read_rbe2(const Card& card, RawDeck& raw) {
  RawRigid rigid;
  rigid.id = card.id(0, "EID");
  rigid.origin = card.origin();
  rigid.reference = card.id(1, "GN");
  rigid.dofs = card.components(2, "CM");
  size_t end = 0;
  rigid.dependents = card.ids(3, "GM", &end);
  if (rigid.dependents.empty()) card.fail_expected(3, "GM", "a dependent grid");
  refuse_expansion(card, end);
  if (!card.blank_from(end)) card.at_most(end + 2);  // ALPHA, TREF
  raw.rigid.push_back(std::move(rigid));
}

void read_rbe3(const Card& card, RawDeck& raw) {
  RawDistributing rbe3;
  rbe3.id = card.id(0, "EID");
  rbe3.origin = card.origin();
  if (!card.blank(1)) card.fail_expected(1, "field 3", "a blank field");
  rbe3.reference = card.id(2, "REFGRID");
  rbe3.dofs = card.components(3, "REFC");
  for (size_t i = 4; i < card.size();) {
    if (card.blank(i)) {
      ++i;
    } else if (card.text(i) == "UM") {
      i = pass_um(card, i, rbe3.dofs);
    } else if (card.text(i) == "ALPHA") {
      refuse_expansion(card, i + 1);
      i += 2;
    } else {
      RawDistributing::Term term;
      term.weight = card.number(i, "WT");
      if (!(term.weight > 0.0)) card.fail_expected(i, "WT", "a positive weight");
      term.dofs = card.components(i + 1, "C");
      size_t end = 0;
      term.grids = card.ids(i + 2, "G", &end);
      if (term.grids.empty()) card.fail_expected(i + 2, "G", "a grid");
      rbe3.terms.push_back(std::move(term));
      i = end;
    }
  }
  if (rbe3.terms.empty()) card.fail_expected(4, "WT1", "a weight");
  raw.distributing.push_back(std::move(rbe3));
}

void read_conm2(const Card& card, RawDeck& raw) {
  RawMass mass;
  mass.origin = card.origin();
  card.id(0, "EID");
  mass.grid = card.id(1, "G");
  mass.system = card.integer_or(2, "CID", 0);
  if (mass.system < -1) card.fail_expected(2, "CID", "a coordinate system, 0 or -1");
  mass.mass = card.number_or(3, "M", 0.0);
  for (size_t k = 0; k < 3; ++k) mass.offset[k] = card.number_or(4 + k, "X", 0.0);
  if (!card.blank(7)) card.fail_expected(7, "field 9", "a blank field");
  for (size_t k = 0; k < 6; ++k) mass.inertia[k] = card.number_or(8 + k, "I", 0.0);
  card.at_most(14);
  raw.masses.push_back(mass);
}

void read_mpc(const Card& card, RawDeck& raw) {
  RawEquation equation;
  equation.set = card.id(0, "SID");
  equation.origin = card.origin();
  for (size_t line = 0; line < card.size(); line += 8) {
    for (const size_t i : {line + 1, line + 4}) {
      if (card.blank(i) && card.blank(i + 1) && card.blank(i + 2)) continue;
      const DofMask dof = card.components(i + 1, "C");
      if (std::popcount(dof) != 1) card.fail_expected(i + 1, "C", "one digit");
      equation.terms.push_back({card.id(i, "G"), std::countr_zero(dof), card.number(i + 2, "A")});
    }
    if (!card.blank(line + 7)) card.fail_expected(line + 7, "field 9", "a blank field");
    if (line > 0 && !card.blank(line)) card.fail_expected(line, "field 2", "a blank field");
  }
  if (equation.terms.empty() || equation.terms.front().coefficient == 0.0) {
    card.fail(3, "expected a first term whose coefficient is not zero");
  }
  raw.mpc[equation.set].push_back(std::move(equation));
}

void read_mpcadd(const Card& card, RawDeck& raw) { add_sum(card, raw.mpc_sums); }
void read_spcadd(const Card& card, RawDeck& raw) { add_sum(card, raw.spc_sums); }

void read_spc(const Card& card, RawDeck& raw) {
  const int32_t set = card.id(0, "SID");
  card.at_most(7);
  for (const size_t i : {size_t{1}, size_t{4}}) {
    if (i > 1 && card.blank_from(i)) break;
    const int32_t grid = card.id(i, "G");
    raw.spc[set].push_back({set,
                            card.origin(),
                            card.components(i + 1, "C"),
                            card.number_or(i + 2, "D", 0.0),
                            {{grid, grid}}});
  }
}

void read_spc1(const Card& card, RawDeck& raw) {
  const int32_t set = card.id(0, "SID");
  raw.spc[set].push_back({set, card.origin(), card.components(1, "C"), 0.0, card.ids(2, "G")});
}

void read_aset(const Card& card, RawDeck& raw) {
  for (size_t i = 0; i < 8; i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    const int32_t grid = card.id(i, "ID");
    raw.retained.push_back({0, card.origin(), card.components(i + 1, "C"), 0.0, {{grid, grid}}});
  }
}

void read_aset1(const Card& card, RawDeck& raw) {
  raw.retained.push_back({0, card.origin(), card.components(0, "C"), 0.0, card.ids(1, "ID")});
}

void read_set1(const Card& card, RawDeck& raw) {
  const int32_t set = card.id(0, "SID");
  if (!raw.node_sets.emplace(set, NodeSet{card.origin(), card.ids(1, "grid")}).second) {
    card.fail(0, fmt::format("found a second set {}", set));
  }
}

}  // namespace clatter::mesh::deck::nastran
