// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Modes of a reduced part, for formats that require them.
#include <Eigen/Core>

#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// K_rr Phi = M_rr Phi Lambda, ascending, Phi^T M_rr Phi = I.
struct PencilModes {
  Eigen::MatrixXd Phi;
  Eigen::VectorXd Lambda;  // [rad2/s2]
  int rigid = 0;           // number of leading ones that are zero to rounding
};

/// All modes by a dense solution; InputError when M_rr is not positive definite.
PencilModes modes_of(const rom::ReducedModel& model);

}  // namespace clatter::condense
