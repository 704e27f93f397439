// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inertia forces of a part whose frame accelerates, also where supports hold it in that frame.
#include <Eigen/Core>

#include "condense/basis/reduced_basis.hpp"

namespace clatter::condense {

/// Forces on the reduced coordinates of unit accelerations x, y, z, rx, ry, rz of the frame, about
/// the origin: V^T (M R + M_qs R_s), r x 6, R and R_s the rigid motions of free and supported DoFs
/// of the full model. A weight is -g times one of these columns. Equal to M_rr rigid where V
/// contains the rigid motions.
Eigen::MatrixXd inertia_force(const PartitionedModel& part, const ReducedBasis& basis);

}  // namespace clatter::condense
