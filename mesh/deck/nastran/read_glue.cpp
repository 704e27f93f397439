// SPDX-License-Identifier: GPL-3.0-or-later
// BGSET and BSURFS.
#include <fmt/format.h>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {

// GSID SID1 TID1 SDIST1, then a line for each further pair.
void read_bgset(const Card& card, RawDeck& raw) {
  RawGlue& glue = raw.glue[card.id(0, "GSID")];
  glue.origin = card.origin();
  for (size_t line = 0; line < card.size(); line += 8) {
    if (card.blank(line + 1) && card.blank(line + 2)) continue;
    glue.pairs.push_back({card.id(line + 1, "SID"), card.id(line + 2, "TID"),
                          card.number_or(line + 3, "SDIST", -1.0)});
  }
}

// ID, three blank fields, then EID G1 G2 G3 of each face.
void read_bsurfs(const Card& card, RawDeck& raw) {
  RawFaces& faces = raw.faces[card.id(0, "ID")];
  faces.origin = card.origin();
  for (size_t i = 4; i < card.size(); i += 4) {
    if (card.blank(i)) continue;
    faces.faces.push_back({card.id(i, "EID"),
                           {card.id(i + 1, "G1"), card.id(i + 2, "G2"), card.id(i + 3, "G3")},
                           card.origin()});
  }
}

}  // namespace clatter::mesh::deck::nastran
