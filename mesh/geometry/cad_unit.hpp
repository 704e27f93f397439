#pragma once
// The length unit that a CAD file is written in, for the user's information: lengths are converted
// when the file is read.
#include <filesystem>
#include <string>

namespace clatter::mesh {

/// Is it a CAD file by its extension: .step, .stp, .brep, .iges, .igs, in any case?
bool is_cad(const std::filesystem::path& path);

/// "mm", "m", "inch" ... as a STEP file's LENGTH_UNIT or an IGES file's global section (parameter
/// 14) say; empty when they do not, and for BREP, which has no unit. InputError when the file
/// cannot be read.
std::string cad_unit(const std::filesystem::path& path);

}  // namespace clatter::mesh
