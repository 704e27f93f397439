// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The factor of a stiffness for statics.
#include "core/fe/fe_model.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::modal {

/// Thin walls have condition numbers above 1e11 and are still solved: the limits of the factor are
/// off, and the errors of the solution are checked instead. Throws sparse::NotPositiveDefinite.
/// @param K of the model, or with other stiffnesses of gaskets; n x n, lower triangle.
sparse::SupernodalFactor static_factor(const SparseMatrix& K);

/// The same; NumericsError names the DoFs of the model whose stiffness is singular.
sparse::SupernodalFactor explained_factor(const fe::FeModel& model, const SparseMatrix& K);

}  // namespace clatter::modal
