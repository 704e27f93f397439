// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parts of decks that the Abaqus tests combine.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "mesh/deck/abaqus/reader.hpp"

namespace clatter::mesh::deck::testing {

/// Unit cube, nodes 1 to 8, element 1 of EALL; nodes 9 and 10 belong to no element. 12 lines.
inline const std::string kCubeNodes =
    "*NODE, NSET=NALL\n"
    "1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n"
    "5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n"
    "9, .5, .5, 2\n10, .5, .5, 2\n";
inline const std::string kCube =
    kCubeNodes + "*ELEMENT, TYPE=C3D8, ELSET=EALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";

/// Its material and section, and the sets of its lower and upper face.
inline const std::string kSteel =
    "*MATERIAL, NAME=Steel\n*ELASTIC\n2.1E5, 0.3\n*DENSITY\n7.8E-9\n"
    "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n"
    "*NSET, NSET=BOT, GENERATE\n1, 4\n*NSET, NSET=TOP\n5, 6, 7, 8\n";

inline const std::string kModel = kCube + kSteel;

inline Deck read(const std::string& text, const std::vector<std::string>& ignore = {}) {
  return read_abaqus_text("deck.inp", text, {ignore});
}

/// The message of the InputError; a failure when there is none.
inline std::string refusal(const std::string& text, const std::vector<std::string>& ignore = {}) {
  try {
    read(text, ignore);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "read without complaint:\n" << text;
  return "";
}

/// Row of node `id` of the deck.
inline int32_t node(const Deck& deck, int32_t id) {
  const auto& ids = deck.mesh.node_ids;
  return static_cast<int32_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
}

/// Node index of the point `id`.
inline NodeIndex point(const Deck& deck, int32_t id) {
  for (size_t p = 0; p < deck.points.size(); ++p) {
    if (deck.points[p].id == id)
      return static_cast<NodeIndex>(deck.mesh.nodes.rows()) + static_cast<NodeIndex>(p);
  }
  ADD_FAILURE() << "no point " << id;
  return -1;
}

/// Deck numbers of rows of the mesh.
inline std::vector<int32_t> ids_of(const Deck& deck, const std::vector<int32_t>& rows) {
  std::vector<int32_t> ids;
  for (const int32_t row : rows) ids.push_back(deck.mesh.node_ids[row]);
  return ids;
}

}  // namespace clatter::mesh::deck::testing
