// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as direct matrix input beside the rest of a Nastran deck.
#include <filesystem>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// For "part.pch": a bulk data file for INCLUDE, with K2GG = KCLATTR, M2GG = MCLATTR and, of a
/// damped part, B2GG = BCLATTR in the case control. Matrices name GRIDs of the deck by their
/// numbers; other nodes get GRIDs, coordinates along other directions and modal ones SPOINTs
/// (bulk_data.hpp). FileError when it cannot be written.
void export_dmig(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
