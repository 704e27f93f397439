// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The inertia invariants where ranks share the rows of the part.
#include "condense/basis/reduced_basis.hpp"
#include "core/ranks/shared_fe_model.hpp"
#include "core/rom/inertia_invariants.hpp"

namespace clatter::condense {

/// As frame_inertia: with T_k the rows of T in direction k, product_kl = V^T (T_k^T m T_l) V, by
/// one solve and six products V^T f for each column; each rank has its rows of T_k^T m T_l and
/// assembles m, n_nodes x n_nodes. Collective; the result is complete on all. InputError as
/// nodal_mass.
/// @param matrices of the part.
rom::InertiaInvariants row_inertia(const PartitionedModel& part,
                                   const ranks::SharedMatrices& matrices,
                                   const ReducedBasis& basis);

}  // namespace clatter::condense
