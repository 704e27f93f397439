// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Point masses with offset and inertia.
#include <Eigen/Core>
#include <vector>

#include "assembly/load/mass_properties.hpp"
#include "assembly/recipe/recipe.hpp"
#include "core/base/sparse.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// Mass on x y z rx ry rz of a node whose mass centre lies at `offset`: m R^T R + [0, J],
/// R = [I, -offset x].
Eigen::Matrix<double, 6, 6> mass_block(const PointMassSpec& spec);

/// Adds a point mass to M on the coordinates of a set: a reference node, or plain nodes that share
/// it. InputError when the set lacks a DoF that the mass needs.
void add_to_set(SparseMatrix& M, const PointMassSpec& spec, const rom::DofSet& set);

/// Adds the masses on points: M += T_p^T block T_p, T_p (6 x n) the rows of `T` from `row` on.
void add_to_point(SparseMatrix& M, const PointMassSpec& spec, const SparseMatrix& T,
                  Eigen::Index row);

/// Adds the mass on a point between supported coordinates and the others: M_sq += T_s,p^T block
/// T_p.
void add_between(SparseMatrix& M_sq, const PointMassSpec& spec, const SparseMatrix& T_s,
                 const SparseMatrix& T, Eigen::Index row);

/// Adds the mass to the moments; the nodes of a set share it evenly.
void add_moments(MassMoments& moments, const PointMassSpec& spec, const rom::DofSet& set);

/// True for a set of one reference node with rotations.
bool has_rotations(const rom::DofSet& set);

}  // namespace clatter::assembly
