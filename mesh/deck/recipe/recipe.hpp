// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The content of a deck besides its mesh, as the fe.toml of clatter-assembly.
#include <string>
#include <vector>

#include "core/recipe/recipe.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// A fe.toml, and lines for people that precede it.
struct Recipe {
  recipe::File file;
  std::vector<std::string> remarks;

  /// The text of the file; read again it gives the same.
  std::string text() const;
};

/// The deck in SI: systems, materials, points, supports, couplings, ties, equations, masses,
/// retained nodes, loads and one [[case]] per step. Node sets and fields that it names and the mesh
/// does not have yet are added to deck.mesh. Everything in the deck is in the recipe or an
/// InputError; what needs a choice of the user (a region without material, a missing density) is a
/// remark.
///
/// A model has one set of supports: those of the entire deck and of its first step. A later step
/// with the same ones becomes a case too; others are named in a remark.
Recipe recipe_of(Deck& deck);

}  // namespace clatter::mesh::deck
