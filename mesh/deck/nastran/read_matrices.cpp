// SPDX-License-Identifier: GPL-3.0-or-later
// DMIG.
#include <fmt/format.h>

#include <bit>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

int direction_in(const Card& card, size_t i) {
  const DofMask dof = card.components_or_none(i, "C");
  if (std::popcount(dof) > 1) card.fail_expected(i, "C", "one digit");
  return dof == 0 ? kScalar : std::countr_zero(dof);
}

// NAME 0 IFO TIN TOUT POLAR: real numbers only.
void read_header(const Card& card, RawDirect& direct) {
  if (direct.form != 0) card.fail(0, fmt::format("found a second header of {}", card.text(0)));
  direct.origin = card.origin();
  direct.form = card.integer(2, "IFO");
  if (card.integer_or(3, "TIN", 1) > 2) direct.form = RawDirect::kComplex;
}

}  // namespace

void read_dmig(const Card& card, RawDeck& raw) {
  RawDirect& direct = raw.direct[std::string(card.text(0))];
  if (card.text(1) == "0") return read_header(card, direct);
  const int32_t column = card.id(1, "GJ");
  const int direction = direction_in(card, 2);
  for (size_t i = 4; i < card.size(); i += 4) {
    if (card.blank(i)) continue;
    direct.entries.push_back({{column, card.id(i, "G")},
                              {direction, direction_in(card, i + 1)},
                              card.number_or(i + 2, "A", 0.0)});
  }
}

}  // namespace clatter::mesh::deck::nastran
