#pragma once
// Physical lines to cards: continuations in every form, INCLUDE, ENDDATA.
//
// A continuation line has nothing in field 1, or + or * and perhaps a name. Without a name it goes
// on with the line before it. With one it goes on with the line before it when that ends in the
// same name, else with the one card of the deck that ends in it, wherever that stands.
#include <cstddef>
#include <string_view>

#include "mesh/deck/nastran/card.hpp"
#include "mesh/deck/nastran/source.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::nastran {

/// Who takes the cards.
class CardSink {
 public:
  virtual ~CardSink() = default;
  /// A card begins: how many data fields it can have at most (a card that has them all waits for no
  /// continuation, whatever its last column says), 0 without limit. May refuse it.
  virtual size_t begin(std::string_view name, Origin origin) = 0;
  /// A card is complete.
  virtual void card(const Card& card) = 0;
  /// A comment line from its $ on.
  virtual void comment(std::string_view line, Origin origin) = 0;
};

/// How reading cards ended.
struct CardsEnd {
  bool complete = true;   // no card was refused
  bool end_data = false;  // there was an ENDDATA
  std::string last;       // name of the last card
  std::string wanted;     // the continuation that it asks for and that is not there
};

/// Reads up to ENDDATA or the end. Cards come in the order of the deck, those that wait for a
/// continuation from elsewhere after all others. Refused: a continuation without a card.
CardsEnd read_cards(Source& source, CardSink& sink, Refusals& refusals);

/// Follows "INCLUDE name" when `line` is one: name with or without quotes; in quotes over several
/// lines. False when it is something else.
bool follow_include(Source& source, std::string_view line);

}  // namespace clatter::mesh::deck::nastran
