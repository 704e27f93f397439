// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Imports a deck file as a mesh in SI for the next stage.
#include <filesystem>

#include "core/mesh/validity.hpp"
#include "mesh/deck/deck.hpp"
#include "mesh/deck/units.hpp"

namespace clatter::mesh::deck {

/// True for the extensions that read_deck() supports: .inp (Abaqus, CalculiX), .bdf, .nas, .dat
/// (Nastran), .fem (OptiStruct); any case.
bool is_deck(const std::filesystem::path& path);

/// Reads the deck in the given units, converts it, makes the surface "skin" and proves that every
/// cell is valid (validity.hpp). InputError with file and line for errors in the deck, and with
/// numbers for inverted cells.
Deck read_deck(const std::filesystem::path& path, const UnitSystem& units,
               const ReadOptions& options);

/// Finishes the deck of any reader as read_deck() does: SI, surface "skin", proof. Messages begin
/// with `where`; the notes of the deck are warnings unless the caller says them.
void finish_deck(Deck& deck, const UnitSystem& units, const std::string& where,
                 bool say_notes = true);

}  // namespace clatter::mesh::deck
