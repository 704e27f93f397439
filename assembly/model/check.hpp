// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rejects models whose reference nodes make M singular or move freely by rounding.
#include <map>
#include <string>

#include "core/base/sparse.hpp"
#include "core/mesh/mesh.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// A reference node with a motion that moves nothing would make M singular: InputError, beginning
/// with `name`. DoFs that only springs hold have no mass: modal analysis excludes such coordinates.
/// @param sets of coordinates. @param M n x n, lower triangle [kg].
void check_references(const std::string& name, const std::map<std::string, rom::DofSet>& sets,
                      const SparseMatrix& M);

/// A rigid body without elastic attachment moves freely: K is zero there, exactly so where its
/// cells belong to it alone. Otherwise elimination leaves rounding of either sign instead of
/// stiffness: InputError, beginning with the mesh's name.
/// @param sets of coordinates. @param K n x n, lower triangle [N/m].
void check_stiffness(const mesh::Mesh& mesh, const std::map<std::string, rom::DofSet>& sets,
                     const SparseMatrix& K);

}  // namespace clatter::assembly
