// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of fasteners and spot welds.
#include <fmt/format.h>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using End = RawFastener::End;

RawFastener without_ends(const Card& card) {
  RawFastener out;
  out.origin = card.origin();
  out.card = card.name();
  out.id = card.id(0, "EID");
  out.property = card.id_or(1, "PID", out.id);
  return out;
}

void take_position(const Card& card, size_t i, RawFastener& out) {
  if (card.blank(i) && card.blank(i + 1) && card.blank(i + 2)) return;
  out.at = {card.number_or(i, "XS", 0.0), card.number_or(i + 1, "YS", 0.0),
            card.number_or(i + 2, "ZS", 0.0)};
}

void require_place(const Card& card, size_t i, const RawFastener& out) {
  if (out.place == 0 && out.piercing[0] == 0 && !out.at)
    card.fail_expected(i, "GS", "a grid, GA, or XS, YS and ZS");
}

/// Two numbers from field i on; without the second one the end is GS.
void take_numbers(const Card& card, size_t i, End kind, const char* what, RawFastener& out) {
  out.kinds = {kind, kind};
  out.numbers = {card.id(i, what), 0};
  if (card.blank(i + 1) && kind == End::kShell && out.place != 0)
    out.kinds[1] = End::kGrid;
  else
    out.numbers[1] = card.id(i + 1, what);
}

/// The grids of a patch, eight fields from i on.
void take_grids(const Card& card, size_t i, size_t end, RawFastener& out) {
  for (size_t k = i; k < i + 8; ++k)
    if (!card.blank(k)) out.grids[end].push_back(card.id(k, "GA"));
  const size_t count = out.grids[end].size();
  out.kinds[end] = End::kGrids;
  if (count == 0 && end == 1 && out.place != 0)
    out.kinds[end] = End::kGrid;
  else if (count != 3 && count != 4 && count != 6 && count != 8)
    card.fail(i, fmt::format("found {} grids of a patch, expected 3, 4, 6 or 8", count));
}

double diameter_of(const Card& card, size_t i) {
  const double diameter = card.number(i, "D");
  if (!(diameter > 0.0)) card.fail_expected(i, "D", "a diameter above 0");
  return diameter;
}

void add(const Card& card, RawFastenerProperty property, RawDeck& raw) {
  property.origin = card.origin();
  property.card = card.name();
  if (!raw.fastener_properties.emplace(card.id(0, "PID"), property).second)
    card.fail(0, "found a second one");
}

}  // namespace

// EID PID TYPE IDA IDB GS GA GB, XS YS ZS.
void read_cfast(const Card& card, RawDeck& raw) {
  RawFastener out = without_ends(card);
  const std::string_view kind = card.text(2);
  if (kind != "PROP" && kind != "ELEM") card.fail_expected(2, "TYPE", "PROP or ELEM");
  out.place = card.id_or(5, "GS", 0);
  out.piercing = {card.id_or(6, "GA", 0), card.id_or(7, "GB", 0)};
  take_position(card, 8, out);
  require_place(card, 5, out);
  const End end = kind == "PROP" ? End::kProperty : End::kShell;
  take_numbers(card, 3, end, kind == "PROP" ? "PIDA" : "SHIDA", out);
  raw.fasteners.push_back(std::move(out));
}

// EID PID GS TYPE GA GB, then the ends.
void read_cweld(const Card& card, RawDeck& raw) {
  constexpr size_t kEnds = 8;
  RawFastener out = without_ends(card);
  out.place = card.id_or(2, "GS", 0);
  out.piercing = {card.id_or(4, "GA", 0), card.id_or(5, "GB", 0)};
  const std::string_view kind = card.text(3);
  if (kind == "ALIGN") {
    out.kinds = {End::kGrid, End::kGrid};
    out.numbers = {card.id(4, "GA"), card.id(5, "GB")};
  } else if (kind == "GRIDID") {
    for (size_t end = 0; end < 2; ++end) take_grids(card, kEnds + 8 * end, end, out);
  } else if (kind == "ELEMID" || kind == "ELPAT") {
    take_numbers(card, kEnds, End::kShell, "SHIDA", out);
  } else if (kind == "PARTPAT") {
    take_numbers(card, kEnds, End::kProperty, "PIDA", out);
  } else {
    card.fail_expected(3, "TYPE", "PARTPAT, ELPAT, ELEMID, GRIDID or ALIGN");
  }
  if (kind == "ELPAT" || kind == "PARTPAT") take_position(card, kEnds + 8, out);
  if (kind != "ALIGN") require_place(card, 2, out);
  for (size_t end = 0; end < 2; ++end)
    if (out.kinds[end] == End::kGrid && kind != "ALIGN") out.numbers[end] = out.place;
  raw.fasteners.push_back(std::move(out));
}

// PID D MCID MFLAG KT1 KT2 KT3 KR1, KR2 KR3 MASS GE.
void read_pfast(const Card& card, RawDeck& raw) {
  RawFastenerProperty out;
  out.diameter = diameter_of(card, 1);
  out.system = card.integer_or(2, "MCID", -1);
  out.is_absolute = card.integer_or(3, "MFLAG", 0) == 1;
  for (size_t k = 0; k < 6; ++k) {
    out.stiffness[k] = card.number_or(4 + k, k < 3 ? "KT" : "KR", 0.0);
    if (!(out.stiffness[k] >= 0.0)) card.fail_expected(4 + k, "K", "a stiffness of 0 or more");
  }
  out.mass = card.number_or(10, "MASS", 0.0);
  if (!(out.mass >= 0.0)) card.fail_expected(10, "MASS", "a mass of 0 or more");
  out.loss_factor = card.number_or(11, "GE", 0.0);
  if (!(out.loss_factor >= 0.0)) card.fail_expected(11, "GE", "a loss factor of 0 or more");
  add(card, out, raw);
}

// PID MID D, MSET, TYPE; LDMIN LDMAX.
void read_pweld(const Card& card, RawDeck& raw) {
  RawFastenerProperty out;
  out.material = card.id(1, "MID");
  out.diameter = diameter_of(card, 2);
  const std::string_view kind = card.text(7);
  if (!kind.empty() && kind != "SPOT") card.fail_expected(7, "TYPE", "SPOT or a blank field");
  out.is_spot = kind == "SPOT";
  out.shortest = card.number_or(8, "LDMIN", out.shortest);
  out.longest = card.number_or(9, "LDMAX", out.longest);
  if (!(out.shortest > 0.0) || !(out.longest >= out.shortest))
    card.fail_expected(8, "LDMIN", "a ratio above 0, not more than LDMAX");
  add(card, out, raw);
}

}  // namespace clatter::mesh::deck::nastran
