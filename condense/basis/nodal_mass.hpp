// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Masses of the nodes of a model, without directions.
#include <functional>

#include "core/base/sparse.hpp"
#include "core/fe/fe_model.hpp"

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

}  // namespace clatter::condense
