// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/reader.hpp"

#include <algorithm>
#include <cctype>

#include "mesh/deck/import.hpp"
#include "mesh/deck/msh/cdb_reader.hpp"
#include "mesh/deck/msh/foreign_deck.hpp"
#include "mesh/deck/msh/med_reader.hpp"
#include "mesh/deck/msh/unv_reader.hpp"
#include "mesh/part/gmsh_in_child.hpp"

namespace clatter::mesh {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

ForeignMesh load(const std::filesystem::path& path, const deck::ReadOptions& options,
                 const ChildLimits& limits) {
  const std::string extension = extension_of(path);
  if (extension == ".unv") return read_unv(path, options.ignore);
  if (extension == ".cdb") return read_cdb(path, options.ignore);
  if (extension == ".med") return read_med(path, options.ignore);
  ForeignMesh found;
  found.scan = scan_msh(path);
  found.contents = read_msh_contents(path, limits);
  return found;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".msh" || extension == ".med" || extension == ".unv" || extension == ".cdb";
}

deck::Deck read_mesh_file(const std::filesystem::path& path, const UnitSystem& units,
                          const deck::ReadOptions& options, const ChildLimits& limits) {
  deck::Deck found = deck_of(load(path, options, limits), path, options);
  deck::finish_deck(found, units, path.string());
  return found;
}

}  // namespace clatter::mesh
