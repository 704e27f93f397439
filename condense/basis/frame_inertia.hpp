// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The inertia invariants of a rotating body, from its nodal masses.
#include "condense/basis/reduced_basis.hpp"
#include "core/rom/inertia_invariants.hpp"

namespace clatter::condense {

/// The shape integrals of core/rom/inertia_invariants.hpp over the nodes, N = T V: with U_k the
/// rows of direction k, product_kl = U_k^T m U_l, moment_lk = U_k^T m x_l, first_k = U_k^T m 1.
/// The basis is processed in blocks of columns. InputError as nodal_mass.
/// @param part of which this process has all rows.
rom::InertiaInvariants frame_inertia(const PartitionedModel& part, const ReducedBasis& basis);

/// product_kk made symmetric, and product_lk = product_kl^T for l > k.
void complete_products(rom::InertiaInvariants& invariants);

}  // namespace clatter::condense
