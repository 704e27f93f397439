// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The crank angle as it is recorded and reported.
#include <numbers>

#include "dynamics/run/model.hpp"

namespace clatter::dynamics {

/// Crank angle at `time` [s] of a model with a crank, 0 = firing TDC [deg].
inline double crank_angle_deg(const Model& model, double time) {
  return model.crank->angle(time) * 180.0 / std::numbers::pi;
}

}  // namespace clatter::dynamics
