// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A mesh.toml.
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/geometry/part_shape.hpp"
#include "mesh/part/mesher.hpp"

namespace clatter::mesh {

/// Table [deck]: a deck with its own cells, of kind "deck".
struct DeckSource {
  std::filesystem::path source;
  UnitSystem units;
  std::vector<std::string> ignore;
  std::string mass = "as in the deck";  // or consistent, lumped
};

struct PartFile {
  std::string name;
  PartShape shape;
  MeshSettings mesh;
  DeckSource deck;
};

/// The keys of a mesh.toml.
const keys::Keys<PartFile>& part_keys();

}  // namespace clatter::mesh
