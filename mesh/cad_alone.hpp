// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A CAD file without a description.
#include <filesystem>

#include "core/base/child_process.hpp"
#include "core/base/config.hpp"

namespace clatter::mesh {

/// The default configuration for a CAD file without a description (cad_description).
Config config_of_cad(const std::filesystem::path& source, double element_size_mm);

/// Element size for that file in millimetres (default_element_size).
double default_element_size_mm(const std::filesystem::path& source, const ChildLimits& limits);

}  // namespace clatter::mesh
