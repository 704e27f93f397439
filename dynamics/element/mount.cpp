// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/mount.hpp"

namespace clatter::dynamics {

Mount::Mount(std::string name, const std::vector<GroundSpring>& springs)
    : name_(std::move(name)),
      stiffness_(static_cast<Eigen::Index>(springs.size())),
      damping_(static_cast<Eigen::Index>(springs.size())) {
  for (size_t i = 0; i < springs.size(); ++i) {
    coordinates_.push_back(springs[i].coordinate);
    stiffness_(static_cast<Eigen::Index>(i)) = springs[i].stiffness;
    damping_(static_cast<Eigen::Index>(i)) = springs[i].damping;
  }
}

void Mount::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                     bool with_tangent, Response& response) {
  response.force = -stiffness_.cwiseProduct(y) - damping_.cwiseProduct(v);
  if (with_tangent) {
    response.tangent.setZero(y.size(), y.size());
    response.tangent.diagonal() = -stiffness_ - damping_ / stage.kappa;
  }
}

Power Mount::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  return {0.5 * y.dot(stiffness_.cwiseProduct(y)), v.dot(damping_.cwiseProduct(v)), 0.0};
}

}  // namespace clatter::dynamics
