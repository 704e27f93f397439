// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/foreign_mesh.hpp"

namespace clatter::mesh {

void ElementTables::add(int dim, int gmsh_type, const std::string& kind,
                        const std::vector<int>& groups, size_t tag,
                        const std::vector<size_t>& nodes) {
  MshElements& table = tables_[{gmsh_type, groups}];
  table.dim = dim;
  table.gmsh_type = gmsh_type;
  table.nodes_each = static_cast<int>(nodes.size());
  table.kind = kind;
  table.groups = groups;
  table.tags.push_back(tag);
  table.nodes.insert(table.nodes.end(), nodes.begin(), nodes.end());
}

std::vector<MshElements> ElementTables::finish() {
  std::vector<MshElements> out;
  for (auto& [key, table] : tables_) out.push_back(std::move(table));
  return out;
}

}  // namespace clatter::mesh
