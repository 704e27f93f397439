// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The content of a deck besides its mesh, as the fe.toml of clatter-assembly.
#include <string>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// The text of a fe.toml in SI: systems, materials, points, supports, couplings, ties, equations,
/// masses, retained nodes, loads and one [[case]] per step. Node sets and fields in the text that
/// the mesh does not have yet are added to deck.mesh. Everything in the deck is either in the text
/// or an InputError; what needs a choice of the user (a region without material, a missing density)
/// is a comment.
///
/// A model has one set of supports: those of the entire deck and of its first step. A later step
/// with the same ones becomes a case too; others are named in a comment.
std::string recipe_text(Deck& deck);

}  // namespace clatter::mesh::deck
