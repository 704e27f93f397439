#pragma once
// Models from matrices that others assembled.
#include <filesystem>
#include <optional>
#include <string>

#include "assembly/build.hpp"
#include "core/base/config.hpp"
#include "core/base/units.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// A diagonal entry of K from which on its DoF counts as held: Abaqus writes 1e36.
inline constexpr double kHeldStiffness = 1e30;

/// Table [matrices] of the fe.toml: what to read instead of assembling.
struct MatrixFiles {
  std::filesystem::path K, M;      // Matrix Market or "i j value" (core/base/matrix_text.hpp)
  std::filesystem::path dofs;      // DoF map (core/rom/dof_map.hpp); empty: the nodes of the mesh
  std::string name;                // of the part; empty: the mesh's
  UnitSystem units;                // of K and M; positions of a map or mesh are in m
  double alpha = 0.0, beta = 0.0;  // D = alpha K + beta M [s], [1/s]
};

/// The table, when the file has one; InputError for anything else beside it.
std::optional<MatrixFiles> read_matrix_files(const Config& config);

/// The model that these matrices and their DoF map describe. Without a map the rows are x y z of
/// the nodes of `mesh`, which come in the order of their numbers, and the sets are its node sets;
/// with one `mesh` is null. DoFs from kHeldStiffness on are held and taken out.
/// The certificate holds dofs, held_dofs, and for a body without held DoFs rigid_force_residue,
/// |K r| / (|K| |r|) of the rigid motions that the positions give, as found.
/// InputError for what the files do not say or what does not fit together: sizes, diagonals that
/// are not positive, directions of a node that are not at right angles.
BuiltModel import_matrices(const MatrixFiles& files, const mesh::Mesh* mesh);

}  // namespace clatter::assembly
