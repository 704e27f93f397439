// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Springs between nodes and points, or to the ground; matrices between them.
#include <vector>

#include "assembly/constraint/elimination.hpp"
#include "assembly/recipe/recipe.hpp"

namespace clatter::assembly {

/// Adds the springs to a stiffness after elimination of the constraints. The elongation of spring i
/// is
///   e_i = c_i^T u = t_i^T q + t_s,i^T s   with t_i = T^T c_i, t_s,i = T_s^T c_i,
/// and its energy k_i e_i^2 / 2 adds k_i t_i t_i^T to K, k_i t_s,i t_i^T to K_sq and
/// k_i t_s,i t_s,i^T to K_ss.
/// @param springs, elongations the same order; c_i on ids of nodes and points.
/// @param K [N/m].
void add_springs(const std::vector<SpringSpec>& springs, const std::vector<Functional>& elongations,
                 const Elimination& elimination, CoordinateBlocks& K);

/// Adds the [[matrix]] tables of one kind in the same way: S on the DoFs C u adds
/// (C T)^T S (C T) to qq.
/// @param dofs of each of `matrices`: one id per row. @param A stiffness, or mass when `of_mass`.
void add_matrices(const std::vector<MatrixSpec>& matrices, const std::vector<Functional>& dofs,
                  bool of_mass, const Elimination& elimination, CoordinateBlocks& A);

}  // namespace clatter::assembly
