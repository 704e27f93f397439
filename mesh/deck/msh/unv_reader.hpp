// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// I-DEAS universal files: datasets 2411 (nodes), 2412 (elements), 2467 and its predecessors
// (groups).
//
// Groups of solids are regions, of shells surfaces, of rods, beams and nodes node sets. Without
// groups of solids the physical properties are regions. Source: I-DEAS Universal File Datasets
// 2411, 2412, 2467.
#include <filesystem>
#include <iosfwd>

#include "mesh/deck/msh/foreign_mesh.hpp"

namespace clatter::mesh {

/// InputError with file and line; `ignore` takes descriptors of elements ("161").
ForeignMesh read_unv(const std::filesystem::path& path, const std::vector<std::string>& ignore);
/// The same from an open file, called `name` in messages.
ForeignMesh read_unv(std::istream& file, const std::string& name,
                     const std::vector<std::string>& ignore);

}  // namespace clatter::mesh
