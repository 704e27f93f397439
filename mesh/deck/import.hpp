#pragma once
// From a deck in a file to a mesh that the next stage can take, in SI.
#include <filesystem>

#include "core/mesh/validity.hpp"
#include "mesh/deck/deck.hpp"
#include "mesh/deck/units.hpp"

namespace clatter::mesh::deck {

/// True for the extensions that read_deck() knows: .inp (Abaqus, CalculiX), .bdf, .nas, .dat
/// (Nastran); any case.
bool is_deck(const std::filesystem::path& path);

/// Reads the deck in the units given, converts it, makes the surface "skin" and proves that every
/// cell is valid (validity.hpp). InputError with file and place for what is wrong in the deck and
/// for inverted cells, by number.
Deck read_deck(const std::filesystem::path& path, const UnitSystem& units,
               const ReadOptions& options);

/// What read_deck() does to any reader's deck: to SI, surface "skin", proof. `where` begins
/// messages.
void finish_deck(Deck& deck, const UnitSystem& units, const std::string& where);

}  // namespace clatter::mesh::deck
