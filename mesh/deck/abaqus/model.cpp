// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {

Model::Model(const Source& deck_source, RawDeck raw, Ignore& ignored, Refusals& all_refusals)
    : source(deck_source),
      ignore(ignored),
      refusals(all_refusals),
      numbering(std::move(raw), deck_source),
      sets(numbering),
      node_map(numbering, deck) {}

}  // namespace clatter::mesh::deck::abaqus
