// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced models as files of other programs.
#include <filesystem>
#include <string>
#include <vector>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// "part.pch (Nastran DMIG), part.inp (CalculiX), ...": the formats by extension.
std::string export_formats();

/// The files that export_reduced() writes for `path`; InputError for another extension.
std::vector<std::filesystem::path> exported_files(const std::filesystem::path& path);

/// Whether the format of `path` has the skin of the part; InputError as exported_files().
bool exports_skin(const std::filesystem::path& path);

/// Writes `model` in the format that the extension of `path` names (the table in export.cpp);
/// returns the files written. InputError for another extension, for units that a format does not
/// have, and for numbers that are taken; FileError when a file cannot be written.
std::vector<std::filesystem::path> export_reduced(const rom::ReducedModel& model,
                                                  const std::filesystem::path& path,
                                                  const ExportOptions& options = {});

}  // namespace clatter::condense
