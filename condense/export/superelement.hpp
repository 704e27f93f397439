// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as external superelements of Nastran, as EXTSEOUT(ASMBULK, EXTID, DMIGPCH) writes
// them (MSC Nastran Quick Reference Guide: EXTSEOUT, SEBULK, SECONCT, BEGIN SUPER).
#include <filesystem>
#include <vector>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// part.asm, part.super.pch for "part.asm".
std::vector<std::filesystem::path> superelement_files(const std::filesystem::path& path);

/// For "part.asm":
///
///   part.asm        for the main bulk data: SEBULK (EXTERNAL, MANUAL), SECONCT of each GRID of the
///                   part to that of the same number in the residual structure, and the GRIDs that
///                   the deck does not have
///   part.super.pch  after the main bulk data: BEGIN SUPER, all GRIDs, SPOINTs, ASET1 of all
///                   coordinates, DMIG KAAX, MAAX and, of a damped part, BAAX
///
/// Coordinates of component 0 are interior to the superelement: the assembly needs no points for
/// them. FileError when a file cannot be written.
void export_superelement(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
