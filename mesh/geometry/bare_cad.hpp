// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The default part.mesh.toml for a CAD file without a description.
#include <filesystem>
#include <string>

namespace clatter::mesh {

/// The description's path next to an output: "out/part.mesh.toml" for "out/part.mesh.h5".
std::filesystem::path description_beside(const std::filesystem::path& output);

/// TOML of kind "cad" for `source`, whose path is relative to the folder of `description`; without
/// [mesh] when `element_size_mm` is 0. The part's name is the file's without extension.
std::string cad_description(const std::filesystem::path& source,
                            const std::filesystem::path& description, double element_size_mm);

/// Writes the text; keeps an existing file and reports it when its text differs.
void keep_description(const std::filesystem::path& description, const std::string& text);

}  // namespace clatter::mesh
