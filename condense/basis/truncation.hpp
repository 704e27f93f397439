// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a basis lacks when the part is joined to others.
#include "condense/basis/residual_modes.hpp"

namespace clatter::condense {

/// ReducedModel::truncation of a part, r x r. With the boundary at u_b and moving at the value
/// lambda, the interior is loaded by lambda H u_b, H = M_ii Psi + M_ib, to which the basis responds
/// by its shapes X alone. To first order in lambda over the values of the lacking shapes,
///   F = H^T K_ii^{-1} H - (X^T H)^T (X^T K_ii X)^{-1} X^T H    in the rows of the boundary,
/// the work of this load that X does not do; X need not be modes. In an assembly, the parts' own
/// truncation is added, V^T F V.
/// Costs two and a half solves with the factor for each boundary coordinate, one and a half more
/// for each part of an assembly. Collective. InputError for an assembly with parts whose F is not
/// known, and for one in a team.
Eigen::MatrixXd truncation(const Reduction& reduction, const sparse::Factor& factor_ii,
                           const PartitionedModel& part);

}  // namespace clatter::condense
