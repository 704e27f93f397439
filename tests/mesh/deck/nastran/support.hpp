// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small decks in memory.
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "mesh/deck/nastran/reader.hpp"

namespace clatter::test {

inline mesh::deck::Deck read_deck(const std::string& text,
                                  const std::vector<std::string>& ignore = {}) {
  return mesh::deck::read_nastran_text("t.bdf", text, {ignore});
}

/// The message with which the deck is refused; empty when it is read.
inline std::string refusal(const std::string& text, const std::vector<std::string>& ignore = {}) {
  try {
    read_deck(text, ignore);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// The unit tetrahedron of four nodes, of a material with E = 210, NU = 0.3, RHO = 7.8.
inline const std::string kTet =
    "PSOLID,1,1\n"
    "MAT1,1,210.,,.3,7.8\n"
    "GRID,1,,0.,0.,0.\n"
    "GRID,2,,1.,0.,0.\n"
    "GRID,3,,0.,1.,0.\n"
    "GRID,4,,0.,0.,1.\n"
    "CTETRA,1,1,1,2,3,4\n";

}  // namespace clatter::test
