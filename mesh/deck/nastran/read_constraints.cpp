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

std::string named(const Card& card) {
  std::string name;
  for (const char c : card.name()) name += static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return fmt::format("{}_{}", name, card.id(0, "EID"));
}

DofMask components_or(const Card& card, size_t i, const char* what, DofMask otherwise) {
  return card.blank(i) ? otherwise : card.components_or_none(i, what);
}

/// `dofs` of `dependent` follow `reference`.
void add_rigid(const Card& card, int32_t reference, DofMask dofs, int32_t dependent, RawDeck& raw) {
  raw.rigid.push_back(
      {named(card), card.id(0, "EID"), card.origin(), reference, dofs, {{dependent, dependent}}});
}

void refuse_expansion(const Card& card, size_t i) {
  if (card.number_or(i, "ALPHA", 0.0) != 0.0) {
    card.fail(i, "thermal expansion of rigid elements (ALPHA) is not supported");
  }
}

// SID, then twice: G, C, D.
void read_moved(const Card& card, std::vector<RawHold>& holds) {
  card.at_most(7);
  for (const size_t i : {size_t{1}, size_t{4}}) {
    if (i > 1 && card.blank_from(i)) break;
    const int32_t grid = card.id(i, "G");
    holds.push_back({card.id(0, "SID"),
                     card.origin(),
                     components_or(card, i + 1, "C", 0),
                     card.number_or(i + 2, "D", 0.0),
                     {{grid, grid}}});
  }
}

}  // namespace

void read_rbe2(const Card& card, RawDeck& raw) {
  RawRigid rigid;
  rigid.name = named(card);
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

// EID GA GB CNA CNB CMA CMB: without CMA and CMB all other DoFs are dependent.
void read_rbar(const Card& card, RawDeck& raw) {
  const int32_t a = card.id(1, "GA"), b = card.id(2, "GB");
  const DofMask free_a = components_or(card, 3, "CNA", 0),
                free_b = components_or(card, 4, "CNB", 0);
  DofMask bound_a = components_or(card, 5, "CMA", 0), bound_b = components_or(card, 6, "CMB", 0);
  refuse_expansion(card, 7);
  card.at_most(9);  // TREF
  if (bound_a == 0 && bound_b == 0) {
    bound_a = static_cast<DofMask>(kAllDofs & ~free_a);
    bound_b = static_cast<DofMask>(kAllDofs & ~free_b);
  }
  if (free_a == kAllDofs && free_b == 0 && bound_a == 0) return add_rigid(card, a, bound_b, b, raw);
  if (free_b == kAllDofs && free_a == 0 && bound_b == 0) return add_rigid(card, b, bound_a, a, raw);
  raw.links.push_back(
      {named(card), card.origin(), {{a, free_a}, {b, free_b}}, {{a, bound_a}, {b, bound_b}}});
}

// EID GA GB CB.
void read_rbar1(const Card& card, RawDeck& raw) {
  refuse_expansion(card, 4);
  card.at_most(6);
  add_rigid(card, card.id(1, "GA"), components_or(card, 3, "CB", kAllDofs), card.id(2, "GB"), raw);
}

// EID GA GB CMA CMB.
void read_rrod(const Card& card, RawDeck& raw) {
  const int32_t a = card.id(1, "GA"), b = card.id(2, "GB");
  const DofMask bound_a = components_or(card, 3, "CMA", 0),
                bound_b = components_or(card, 4, "CMB", 0);
  if (std::popcount(bound_a) + std::popcount(bound_b) != 1 ||
      ((bound_a | bound_b) & ~kTranslations) != 0)
    card.fail(3, "CMA, CMB: expected one of the digits 1 to 3 in one of them");
  refuse_expansion(card, 5);
  card.at_most(7);
  raw.links.push_back({named(card),
                       card.origin(),
                       {{a, static_cast<DofMask>(kTranslations & ~bound_a)},
                        {b, static_cast<DofMask>(kTranslations & ~bound_b)}},
                       {{a, bound_a}, {b, bound_b}},
                       true});
}

// EID GN1 CN1 GN2 CN2 ... UM GM1 CM1 ...
void read_rbe1(const Card& card, RawDeck& raw) {
  RawLink link{named(card), card.origin(), {}, {}};
  bool dependent = false;
  for (size_t i = 1; i < card.size();) {
    if (card.blank(i)) {
      ++i;
    } else if (card.text(i) == "UM") {
      dependent = true;
      ++i;
    } else if (card.text(i) == "ALPHA" || (dependent && !card.is_integer(i))) {
      refuse_expansion(card, card.is_word(i) ? i + 1 : i);
      break;
    } else {
      (dependent ? link.dependent : link.independent)
          .push_back({card.id(i, "G"), card.components(i + 1, "C")});
      i += 2;
    }
  }
  if (link.independent.empty() || link.dependent.empty())
    card.fail(1, "expected independent grids, UM and dependent grids");
  if (link.independent.size() > 1 || link.independent[0].dofs != kAllDofs) {
    raw.links.push_back(std::move(link));
    return;
  }
  for (const RawLink::End& end : link.dependent)
    add_rigid(card, link.independent[0].grid, end.dofs, end.grid, raw);
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
  mass.id = card.id(0, "EID");
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

void read_conm1(const Card& card, RawDeck& raw) {
  RawMassMatrix mass;
  mass.origin = card.origin();
  card.id(0, "EID");
  mass.grid = card.id(1, "G");
  mass.system = card.integer_or(2, "CID", 0);
  if (mass.system < 0) card.fail_expected(2, "CID", "a coordinate system, 0 or more");
  for (size_t k = 0; k < 21; ++k) mass.lower[k] = card.number_or(3 + k, "M", 0.0);
  card.at_most(24);
  raw.mass_matrices.push_back(mass);
}

void read_mpc(const Card& card, RawDeck& raw) {
  RawEquation equation;
  equation.set = card.id(0, "SID");
  equation.origin = card.origin();
  for (size_t line = 0; line < card.size(); line += 8) {
    for (const size_t i : {line + 1, line + 4}) {
      if (card.blank(i) && card.blank(i + 1) && card.blank(i + 2)) continue;
      const DofMask dof = card.components_or_none(i + 1, "C");
      if (std::popcount(dof) > 1) card.fail_expected(i + 1, "C", "one digit");
      equation.terms.push_back(
          {card.id(i, "G"), dof == 0 ? kScalar : std::countr_zero(dof), card.number(i + 2, "A")});
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

void read_spc(const Card& card, RawDeck& raw) { read_moved(card, raw.spc[card.id(0, "SID")]); }

void read_spcd(const Card& card, RawDeck& raw) {
  const auto [at, fresh] = raw.loads.try_emplace(card.id(0, "SID"));
  if (fresh) at->second.origin = card.origin();
  read_moved(card, at->second.moved);
}

void read_spc1(const Card& card, RawDeck& raw) {
  const int32_t set = card.id(0, "SID");
  const DofMask dofs = card.text(1) == "0" ? DofMask{0} : card.components(1, "C");
  raw.spc[set].push_back({set, card.origin(), dofs, 0.0, card.ids(2, "G")});
}

void read_aset(const Card& card, RawDeck& raw) {
  for (size_t i = 0; i < 8; i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    const int32_t grid = card.id(i, "ID");
    raw.retained.push_back(
        {0, card.origin(), components_or(card, i + 1, "C", 0), 0.0, {{grid, grid}}});
  }
}

void read_aset1(const Card& card, RawDeck& raw) {
  raw.retained.push_back(
      {0, card.origin(), components_or(card, 0, "C", 0), 0.0, card.ids(1, "ID")});
}

void read_set1(const Card& card, RawDeck& raw) {
  const int32_t set = card.id(0, "SID");
  if (!raw.node_sets.emplace(set, NodeSet{card.origin(), card.ids(1, "grid")}).second) {
    card.fail(0, fmt::format("found a second set {}", set));
  }
}

}  // namespace clatter::mesh::deck::nastran
