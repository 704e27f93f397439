// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/periodicity.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

CycleDifference cycle_difference(const Model& model, const UniformSamples& now,
                                 const RowMatrix& eta_before, const RowMatrix& v_before) {
  CycleDifference result;
  if (v_before.rows() != now.v().rows() || now.count() != now.v().rows()) return result;
  const auto& bodies = model.system.bodies();
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
    const auto at = model.system.mode_offset(b), n = bodies[static_cast<size_t>(b)].modes();
    const double all = now.v().middleCols(at, n).squaredNorm();
    const double difference =
        (now.v().middleCols(at, n) - v_before.middleCols(at, n)).squaredNorm();
    result.velocity[bodies[static_cast<size_t>(b)].name] =
        all > 0.0 ? std::sqrt(difference / all) : 0.0;
  }
  if (model.pin_y < 0) return result;
  Eigen::Vector2d largest = Eigen::Vector2d::Zero();
  for (int i = 0; i < now.count(); ++i) {
    const Eigen::VectorXd change = (now.eta().row(i) - eta_before.row(i)).transpose();
    const Eigen::Vector2d motion =
        model.secondary_motion(now.time(i), model.system.interface(change));
    largest = largest.cwiseMax(motion.cwiseAbs());
  }
  result.lateral = largest.x();
  result.tilt = largest.y();
  return result;
}

}  // namespace clatter::dynamics
