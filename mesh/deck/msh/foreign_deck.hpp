// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A mesh with groups as a deck: regions, surfaces, node sets (reader.hpp).
#include <filesystem>

#include "mesh/deck/msh/foreign_mesh.hpp"

namespace clatter::mesh {

/// The deck of a file's mesh, before finish_deck() (deck/import.hpp). `path` is for messages and
/// the name of the part. InputError as for read_mesh_file() (reader.hpp).
deck::Deck deck_of(ForeignMesh found, const std::filesystem::path& path,
                   const deck::ReadOptions& options);

}  // namespace clatter::mesh
