// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The DoF of each row of matrices in text files: written next to exported matrices, read with
// matrices of other programs.
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::rom {

/// One row and column of the matrices.
struct MappedDof {
  enum class Kind { kDisplacement, kRotation, kModal };
  Kind kind = Kind::kModal;
  int node = 0;       // from 1; DoFs of one node have one position
  int component = 0;  // 1 2 3 displacement along, 4 5 6 rotation about the global x y z; 0: neither
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   // [m]; zero for a modal DoF
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit vector; zero for a modal DoF
  std::string set;                                      // empty for a modal DoF
  std::string label;
  bool of_deck = false;  // `node` is its number in the deck of the mesh
  bool turned = false;   // the component is along or about axes of its own of the deck's node
};

/// Numbers of nodes that the deck does not have.
struct NodeNumbering {
  int32_t first_node = 0;    // 0: 1; of a part from a deck a round number after those of the deck
  int32_t first_scalar = 0;  // of DoFs of component 0; 0: one count together with the nodes
  bool deck_axes = false;    // DoFs along axes of their own of the deck's nodes have components
};

/// Entry j is coordinate j. A DoF in two sets gets the position of the first by name. Boundary DoFs
/// of one set at one position share a node when their components differ; every DoF of component 0,
/// and every modal one, has its own node. DoFs along or about x, y, z of nodes of the deck that the
/// part came from have the deck's numbers.
std::vector<MappedDof> map_of(const ReducedModel& model, const NodeNumbering& numbering = {});

/// The smallest power of ten above `number`, plus one; above 10^7 the next number.
int32_t round_number_after(int32_t number);

/// Text, one DoF per line, tab-separated, SI, numbers exact on reading:
///   i  node  component  kind  x  y  z  dx  dy  dz  set  label
/// with kind displacement, rotation or modal. Lines that begin with # are comments.
void write_dof_map(const std::filesystem::path& path, const std::vector<MappedDof>& map);

/// Reads the map; InputError "file:line: ..." for columns, numbers and directions that are not as
/// above, and for DoFs of one node at different positions.
std::vector<MappedDof> read_dof_map(const std::filesystem::path& path);

}  // namespace clatter::rom
