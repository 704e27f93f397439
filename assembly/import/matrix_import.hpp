// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Models from matrices that other programs assembled.
#include "assembly/model/build.hpp"
#include "assembly/recipe/recipe.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// A DoF with at least this diagonal entry of K is held: Abaqus writes 1e36.
inline constexpr double kHeldStiffness = 1e30;

/// The model of these matrices and their DoF map. Without a map the rows are x y z of the nodes of
/// `mesh` in ascending order of node numbers, and the sets are its node sets; with a map, `mesh` is
/// null. DoFs with kHeldStiffness or more are held and removed.
/// The certificate holds dofs, held_dofs, and for a body without held DoFs rigid_force_residue,
/// |K r| / (|K| |r|) of the rigid motions computed from the positions.
/// InputError for missing data and inconsistencies: sizes, diagonals that are not positive,
/// directions of a node that are not orthogonal.
BuiltModel import_matrices(const MatrixFiles& files, const mesh::Mesh* mesh);

}  // namespace clatter::assembly
