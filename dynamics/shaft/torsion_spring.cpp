// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/torsion_spring.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

double TorsionSpring::beyond(const Eigen::VectorXd& y) const {
  const double twist = y(0) - y(1);
  return std::copysign(std::max(0.0, std::abs(twist) - 0.5 * law_.backlash), twist);
}

void TorsionSpring::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                             bool with_tangent, Response& response) {
  const double twist = beyond(y);
  const double moment = -law_.stiffness * twist - law_.damping * (v(0) - v(1));
  response.force.resize(2);
  response.force << moment, -moment;
  if (!with_tangent) return;
  const bool touches = law_.backlash == 0.0 || twist != 0.0;
  const double slope = -(touches ? law_.stiffness : 0.0) - law_.damping / stage.kappa;
  response.tangent.resize(2, 2);
  response.tangent << slope, -slope, -slope, slope;
}

Power TorsionSpring::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const double twist = beyond(y), rate = v(0) - v(1);
  return {0.5 * law_.stiffness * twist * twist, law_.damping * rate * rate, 0.0};
}

}  // namespace clatter::dynamics
