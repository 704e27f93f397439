// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The inertia invariants where a team shares the rows of the part.
#include "condense/basis/dof_partition.hpp"
#include "condense/basis/reduced_basis.hpp"
#include "core/rom/inertia_invariants.hpp"

namespace clatter::condense {

/// As frame_inertia, for `part.shared`: with T_k the rows of T in direction k, product_kl =
/// V^T (T_k^T m T_l) V, by one solve and six products V^T f for each column. Every process
/// assembles m, n_nodes x n_nodes. Collective; the result is complete on all. InputError as
/// nodal_mass.
rom::InertiaInvariants frame_inertia_of_rows(const PartitionedModel& part,
                                             const ReducedBasis& basis);

}  // namespace clatter::condense
