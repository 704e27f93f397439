// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A mesh with groups as files of other programs have it, before it is a Deck.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"
#include "mesh/deck/deck.hpp"
#include "mesh/deck/msh/scan.hpp"

namespace clatter::mesh {

/// Elements in Gmsh's types and node orders, with the names of their groups.
struct ForeignMesh {
  MshScan scan;
  MshContents contents;
  std::map<std::string, deck::Region> regions;  // by name, where the file has properties
  std::map<std::string, deck::Material> materials;
  std::map<std::string, int64_t> ignored;  // Deck::ignored
  std::vector<std::string> notes;          // Deck::notes
};

/// Collects elements of one kind and one list of groups.
class ElementTables {
 public:
  /// `gmsh_type`, nodes in Gmsh's order.
  void add(int dim, int gmsh_type, const std::string& kind, const std::vector<int>& groups,
           size_t tag, const std::vector<size_t>& nodes);
  std::vector<MshElements> finish();

 private:
  std::map<std::pair<int, std::vector<int>>, MshElements> tables_;
};

}  // namespace clatter::mesh
