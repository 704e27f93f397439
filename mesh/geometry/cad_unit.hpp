// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The length unit of a CAD file, for the user's information: lengths are converted when the file is
// read.
#include <filesystem>
#include <string>

namespace clatter::mesh {

/// True for the extensions of CAD files: .step, .stp, .brep, .iges, .igs, in any case.
bool is_cad(const std::filesystem::path& path);

/// "mm", "m", "inch" ... from a STEP file's LENGTH_UNIT or an IGES file's global section (parameter
/// 14); empty when it is missing, and for BREP, which has no unit. InputError when the file cannot
/// be read.
std::string cad_unit(const std::filesystem::path& path);

}  // namespace clatter::mesh
