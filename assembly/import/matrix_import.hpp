// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Models from matrices that other programs assembled.
#include <filesystem>
#include <optional>
#include <string>

#include "assembly/model/build.hpp"
#include "core/base/config.hpp"
#include "core/base/units.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// A DoF with at least this diagonal entry of K is held: Abaqus writes 1e36.
inline constexpr double kHeldStiffness = 1e30;

/// Table [matrices] of the fe.toml: matrices to read instead of assembling.
struct MatrixFiles {
  std::filesystem::path K, M;      // Matrix Market or "i j value" (core/base/matrix_text.hpp)
  std::filesystem::path dofs;      // DoF map (core/rom/dof_map.hpp); empty: the nodes of the mesh
  std::string name;                // of the part; empty: the mesh's
  UnitSystem units;                // of K and M; positions of a map or mesh are in m
  double alpha = 0.0, beta = 0.0;  // D = alpha K + beta M [s], [1/s]
};

/// The table, when the file has one; InputError for any other table beside it.
std::optional<MatrixFiles> read_matrix_files(const Config& config);

/// The model of these matrices and their DoF map. Without a map the rows are x y z of the nodes of
/// `mesh` in ascending order of node numbers, and the sets are its node sets; with a map, `mesh` is
/// null. DoFs with kHeldStiffness or more are held and removed.
/// The certificate holds dofs, held_dofs, and for a body without held DoFs rigid_force_residue,
/// |K r| / (|K| |r|) of the rigid motions computed from the positions.
/// InputError for missing data and inconsistencies: sizes, diagonals that are not positive,
/// directions of a node that are not orthogonal.
BuiltModel import_matrices(const MatrixFiles& files, const mesh::Mesh* mesh);

}  // namespace clatter::assembly
