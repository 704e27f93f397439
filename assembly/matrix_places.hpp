#pragma once
// Where the rows of imported matrices are: nodes, rigid motions, displacements, sets.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh.hpp"
#include "core/rom/dof_map.hpp"

namespace clatter::assembly {

/// The rows with their nodes.
struct MatrixPlaces {
  std::vector<rom::MappedDof> dofs;
  std::vector<int32_t> node;  // row of `nodes` of each DoF; -1 of a modal one
  RowMatrix nodes;            // [m]
  std::map<std::string, std::vector<int32_t>> sets;  // DoFs
};

/// x y z of each node, nodes in ascending order of their numbers; its node sets.
MatrixPlaces places_of(const mesh::Mesh& mesh);

/// The nodes and sets that the map names. InputError, beginning with `file`, when directions of one
/// node's displacements are not at right angles.
MatrixPlaces places_of(std::vector<rom::MappedDof> map, const std::string& file);

/// q of the unit rigid motions x, y, z, rx, ry, rz about the origin, n x 6; zero for modal DoFs,
/// which take no part in them (fixed-interface modes).
Eigen::MatrixXd rigid_motions(const std::vector<rom::MappedDof>& dofs);

/// Nodal displacement u = T q, 3 nodes x `size`; DoF j is coordinate place[j], none below 0.
SparseMatrix displacement_of(const MatrixPlaces& places, const std::vector<int32_t>& place,
                             int32_t size);

/// Sets of the coordinates that are left; a set of which nothing is left is left out.
std::map<std::string, rom::DofSet> sets_of(const MatrixPlaces& places,
                                           const std::vector<int32_t>& place);

}  // namespace clatter::assembly
