// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The inertia invariants of a rotating body, from its nodal masses.
#include <functional>

#include "condense/basis/dof_partition.hpp"
#include "condense/basis/reduced_basis.hpp"
#include "core/rom/inertia_invariants.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// Scalar mass matrix m of the nodes: M = T^T (m x I_3) T. Assembled again from the model's cells,
/// consistent or lumped as M; without cells taken from M itself when q are the nodal displacements.
/// n_nodes x n_nodes [kg], lower triangle. InputError when neither reproduces M to 1e-10: point
/// masses on references and imported matrices with constraints have no nodal form.
SparseMatrix nodal_mass(const fe::FeModel& model);

/// Entries (3 a, 3 b) of a matrix 3 n x 3 n that couples no directions, n x n.
SparseMatrix without_directions(const SparseMatrix& M);

/// The same where M is not at hand.
/// @param direct without_directions(M), for a model without eliminated displacements.
/// @param gives_back whether m reproduces M.
SparseMatrix nodal_mass(const fe::FeModel& model, const std::function<SparseMatrix()>& direct,
                        const std::function<bool(const SparseMatrix& m)>& gives_back);

/// The shape integrals of core/rom/inertia_invariants.hpp over the nodes, N = T V: with U_k the
/// rows of direction k, product_kl = U_k^T m U_l, moment_lk = U_k^T m x_l, first_k = U_k^T m 1.
/// The basis is processed in blocks of columns. A team computes the same as V^T (T_k^T m T_l) V,
/// each process with its rows of T_k^T m T_l. InputError as nodal_mass.
rom::InertiaInvariants frame_inertia(const PartitionedModel& part, const ReducedBasis& basis);

/// product_kk made symmetric, and product_lk = product_kl^T for l > k.
void complete_products(rom::InertiaInvariants& invariants);

/// Largest relative deviation from the values that follow from the rigid motions r and M_rr: sum_k
/// product_kk = M_rr; for a body whose six motions are free first_k = M_rr r_k, moment_lk -
/// moment_kl = M_rr r_(3+j), and place against the mass properties.
double inertia_error(const rom::ReducedModel& reduced, bool free_body);

}  // namespace clatter::condense
