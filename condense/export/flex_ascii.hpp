// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as superelements of OpenFAST's module ExtPtfm.
#include <filesystem>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// For "part.flexascii": the Red_FileName of an ExtPtfm input file with FileFormat FlexASCII
/// (OpenFAST documentation, ExtPtfm, "Superelement input file"): mass, stiffness and damping of the
/// six motions x y z rx ry rz of the interface, then of the modes with the interface held, unit
/// modal masses. Boundary coordinates besides the interface become part of these modes: the pencil
/// is the same. All loads are zero at 0 s and 10 000 s: weight and waves are the user's. InputError
/// when no set, or several, have these six coordinates (options.interface names one). FileError
/// when it cannot be written.
void export_flex_ascii(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
