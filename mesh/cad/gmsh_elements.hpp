// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to the files that read Gmsh's meshes.
#include <algorithm>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"
#include "mesh/cad/gmsh_call.hpp"

namespace clatter::mesh {

/// Gmsh's element types.
inline constexpr int kLine2 = 1, kTri3 = 2, kQuad4 = 3, kTet4 = 4, kLine3 = 8, kTri6 = 9,
                     kTet10 = 11, kQuad8 = 16;

/// Gmsh's node tags -> rows; only nodes of cells are kept, in ascending order of their tags.
class NodeNumbers {
 public:
  void use(const std::vector<size_t>& tags) { used_.insert(used_.end(), tags.begin(), tags.end()); }
  void close() {
    std::sort(used_.begin(), used_.end());
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  }
  int32_t row(size_t tag) const {
    const auto at = std::lower_bound(used_.begin(), used_.end(), tag);
    if (at == used_.end() || *at != tag) {
      throw NumericsError("Gmsh left a face with a node that belongs to no cell");
    }
    return static_cast<int32_t>(at - used_.begin());
  }
  bool has(size_t tag) const { return std::binary_search(used_.begin(), used_.end(), tag); }
  const std::vector<size_t>& tags() const { return used_; }

 private:
  std::vector<size_t> used_;
};

/// Rows of `columns` nodes.
inline IndexMatrix table_of(const std::vector<size_t>& tags, int columns,
                            const NodeNumbers& numbers) {
  IndexMatrix table(static_cast<Eigen::Index>(tags.size()) / columns, columns);
  for (size_t i = 0; i < tags.size(); ++i) table.data()[i] = numbers.row(tags[i]);
  return table;
}

/// Nodes of the elements of a type on an entity of its dimension.
inline std::vector<size_t> element_nodes(int type, int entity) {
  std::vector<size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(type, elements, nodes, entity);
  return nodes;
}

/// n x 3, in the part's unit.
inline RowMatrix coordinates_of(const NodeNumbers& numbers) {
  std::vector<size_t> tags;
  std::vector<double> xyz, parameters;
  gmsh::model::mesh::getNodes(tags, xyz, parameters, -1, -1, false, false);
  RowMatrix nodes(static_cast<Eigen::Index>(numbers.tags().size()), 3);
  for (size_t i = 0; i < tags.size(); ++i) {
    if (!numbers.has(tags[i])) continue;
    nodes.row(numbers.row(tags[i])) << xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2];
  }
  return nodes;
}

}  // namespace clatter::mesh
