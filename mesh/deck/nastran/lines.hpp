// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Joins physical lines to cards: continuations in every form, INCLUDE, ENDDATA.
//
// A continuation line has a blank field 1, or + or * and optionally a name. Without a name it
// continues the line before it. With one it continues the line before it if that ends in the same
// name, else the one card of the deck that ends in it, wherever that is.
#include <cstddef>
#include <string_view>

#include "mesh/deck/nastran/card.hpp"
#include "mesh/deck/nastran/source.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::nastran {

/// The receiver of the cards.
class CardSink {
 public:
  virtual ~CardSink() = default;
  /// A card begins: returns the maximum number of data fields (a card that has them all expects no
  /// continuation, whatever its last column holds), 0 for no limit. May refuse it.
  virtual size_t begin(std::string_view name, Origin origin) = 0;
  /// A card is complete.
  virtual void card(const Card& card) = 0;
  /// A comment line from its $ on.
  virtual void comment(std::string_view line, Origin origin) = 0;
  /// A BEGIN SUPER = n: cards of another part follow, with numbers of their own.
  virtual void begin_section(std::string_view line, Origin origin) = 0;
};

/// The result of reading cards.
struct CardsEnd {
  bool complete = true;              // no card was refused
  bool end_data = false;             // there was an ENDDATA
  std::string last;                  // name of the last card
  std::string missing_continuation;  // of that card
};

/// Reads up to ENDDATA or the end. Cards are passed in the order of the deck, those with a
/// continuation elsewhere after all others. Refused: a continuation without a card.
CardsEnd read_cards(Source& source, CardSink& sink, Refusals& refusals);

/// Follows "INCLUDE name" when `line` is one: name with or without quotes; in quotes over several
/// lines. False for any other line.
bool follow_include(Source& source, std::string_view line);

}  // namespace clatter::mesh::deck::nastran
