// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Difference of one cycle from the previous one.
#include <map>
#include <string>

#include "dynamics/run/model.hpp"
#include "dynamics/run/recorder.hpp"

namespace clatter::dynamics {

/// Differences between two cycles at equal crank angles; empty when there was only one.
///
/// `periodicity_<body>`: sqrt(sum |v - v'|^2 / sum |v|^2) over modal velocities, the norm of
/// kinetic energy; `periodicity_lateral` [m] and `periodicity_tilt` [rad]: largest difference of
/// the piston's secondary motion.
std::map<std::string, double> cycle_difference(const Model& model, const UniformSamples& now,
                                               const RowMatrix& eta_before,
                                               const RowMatrix& v_before);

}  // namespace clatter::dynamics
