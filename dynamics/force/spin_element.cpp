// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/spin_element.hpp"

#include <utility>

#include "dynamics/force/rotation.hpp"

namespace clatter::dynamics {

SpinElement::SpinElement(std::string body, std::vector<int> coordinates,
                         const Eigen::Vector3d& inertia)
    : ForceElement(std::move(coordinates)), body_(std::move(body)), inertia_(inertia) {}

void SpinElement::evaluate(const Stage&, const Eigen::VectorXd& y, const Eigen::VectorXd&,
                           bool with_tangent, Response& response) {
  const Eigen::Vector4d q = y.head<4>();
  const Eigen::Vector3d w = y.tail<3>();
  const Eigen::Vector3d momentum = inertia_.cwiseProduct(w);
  const Matrix43 Q = quaternion_rates(q);
  response.force.resize(7);
  response.force.head<4>() = 0.5 * Q * w;
  response.force.tail<3>() = momentum.cross(w);
  if (!with_tangent) return;
  response.tangent.setZero(7, 7);
  response.tangent.topLeftCorner<4, 4>() = 0.5 * spin_matrix(w);
  response.tangent.topRightCorner<4, 3>() = 0.5 * Q;
  response.tangent.bottomRightCorner<3, 3>() = skew(momentum) - skew(w) * inertia_.asDiagonal();
}

Power SpinElement::power(const Eigen::VectorXd& y, const Eigen::VectorXd&) const {
  const Eigen::Vector3d w = y.tail<3>();
  return {0.5 * w.dot(inertia_.cwiseProduct(w)), 0.0, 0.0};
}

}  // namespace clatter::dynamics
