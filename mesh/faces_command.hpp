// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-mesh --faces.
#include <filesystem>

#include "core/base/child_process.hpp"
#include "core/base/command_line.hpp"
#include "core/base/config.hpp"

namespace clatter::mesh {

/// Lists the faces of a CAD file or a part.mesh.toml on stdout, by --json as one JSON line, and
/// writes them with triangles to `output` (.faces.h5) unless that is empty. InputError for decks
/// and meshes, which have no CAD faces.
void show_faces(const std::filesystem::path& input, const std::filesystem::path& output,
                const ChildLimits& limits, const CommonOptions& common);

/// The default configuration for a CAD file without a description (cad_description).
Config config_of_cad(const std::filesystem::path& source, double element_size_mm);

/// Element size for that file in millimetres (default_element_size).
double default_element_size_mm(const std::filesystem::path& source, const ChildLimits& limits);

}  // namespace clatter::mesh
