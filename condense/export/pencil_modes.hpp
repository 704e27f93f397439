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

  int elastic() const { return static_cast<int>(Lambda.size()) - rigid; }
};

/// All modes by a dense solution; InputError when M_rr is not positive definite.
PencilModes modes_of(const rom::ReducedModel& model);

/// The elastic ones alone, `rigid` 0: floating frames of reference make the rigid motions.
PencilModes elastic_modes_of(const rom::ReducedModel& model);

/// alpha K_rr + beta M_rr, and M_rr Phi diag(2 zeta omega) Phi^T M_rr of the table of modal damping
/// and of loss factors.
Eigen::MatrixXd damping_of(const rom::ReducedModel& model);

}  // namespace clatter::condense
