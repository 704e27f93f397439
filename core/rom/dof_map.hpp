#pragma once
// Which degree of freedom stands in which row of matrices in text files: written beside exported
// matrices, read with matrices that others made.
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
  int component = 0;  // 1 2 3 displacement along, 4 5 6 rotation about the basic x y z; 0: neither
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   // [m]; zero of a modal DoF
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit vector; zero of a modal DoF
  std::string set;                                      // empty of a modal DoF
  std::string label;
};

/// Entry j is coordinate j. A DoF of two sets has the place of the first by name. Boundary DoFs of
/// one set at one position share a node when their components differ; every DoF of component 0, and
/// every modal one, has a node of its own.
std::vector<MappedDof> map_of(const ReducedModel& model);

/// Text, one DoF a line, columns separated by tabs, SI, numbers that read back to the last bit:
///   i  node  component  kind  x  y  z  dx  dy  dz  set  label
/// with kind displacement, rotation or modal. Lines that begin with # are comments.
void write_dof_map(const std::filesystem::path& path, const std::vector<MappedDof>& map);

/// Reads it back; InputError "file:line: ..." for columns, numbers and directions that are not as
/// above, and for DoFs of one node at different positions.
std::vector<MappedDof> read_dof_map(const std::filesystem::path& path);

}  // namespace clatter::rom
