// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/disc_gyroscope.hpp"

namespace clatter::dynamics {

void DiscGyroscope::evaluate(const Stage& stage, const Eigen::VectorXd&, const Eigen::VectorXd& v,
                             bool with_tangent, Response& response) {
  const double momentum = polar_ * v(2);
  response.force.setZero(3);
  response.force(0) = -momentum * v(1);
  response.force(1) = momentum * v(0);
  if (!with_tangent) return;
  response.tangent.setZero(3, 3);
  response.tangent(0, 1) = -momentum / stage.kappa;
  response.tangent(1, 0) = momentum / stage.kappa;
  response.tangent(0, 2) = -polar_ * v(1) / stage.kappa;
  response.tangent(1, 2) = polar_ * v(0) / stage.kappa;
}

}  // namespace clatter::dynamics
