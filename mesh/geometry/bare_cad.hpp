#pragma once
// A CAD file without a description: the part.mesh.toml that is meant by it.
#include <filesystem>
#include <string>

namespace clatter::mesh {

/// The description's name beside an output: "out/part.mesh.toml" for "out/part.mesh.h5".
std::filesystem::path description_beside(const std::filesystem::path& output);

/// TOML of kind "cad" for `source`, which it names relative to the folder of `description`; without
/// [mesh] when `element_size_mm` is 0. Its name is the file's without extension.
std::string cad_description(const std::filesystem::path& source,
                            const std::filesystem::path& description, double element_size_mm);

/// Writes the text, or leaves what is there and says so when it is another text.
void keep_description(const std::filesystem::path& description, const std::string& text);

}  // namespace clatter::mesh
