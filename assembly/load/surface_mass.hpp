// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[surface_mass]]: the matrix and the moments of masses per area.
#include "assembly/constraint/part_data.hpp"
#include "assembly/load/mass_properties.hpp"
#include "core/base/sparse.hpp"

namespace clatter::assembly {

/// Sum over the surfaces of m int N_a N_b dA on x, y, z of their nodes [kg]: the lower triangle on
/// all ids, or 0 x 0 without surface masses. Consistent also where the cells are lumped.
SparseMatrix surface_mass_matrix(const PartData& part);

/// Adds what the same points have.
void add_surfaces(MassMoments& moments, const PartData& part);

}  // namespace clatter::assembly
