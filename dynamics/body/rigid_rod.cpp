// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/rigid_rod.hpp"

#include <cmath>

namespace clatter::dynamics {

RodProperties two_mass_rod(const RodProperties& rod) {
  RodProperties two = rod;
  two.inertia = rod.mass * rod.centre * (rod.length - rod.centre);
  return two;
}

ModalBody make_rigid_rod(const std::string& name, const RodProperties& rod) {
  const Eigen::Vector3d masses(rod.mass, rod.mass, rod.inertia);
  ModalBody body;
  body.name = name;
  body.shapes = masses.cwiseSqrt().cwiseInverse().asDiagonal();
  body.omega_squared = Eigen::VectorXd::Zero(3);
  body.damping = Eigen::VectorXd::Zero(3);
  body.inertia = Eigen::VectorXd::Ones(3);
  body.rigid = Eigen::MatrixXd::Zero(3, 6);
  body.rigid(0, 1) = std::sqrt(rod.mass);
  body.rigid(1, 2) = std::sqrt(rod.mass);
  body.rigid(2, 3) = std::sqrt(rod.inertia);
  body.is_rotation = {0, 0, 1};
  body.rigid_modes = 3;
  body.mass = rod.mass;
  return body;
}

}  // namespace clatter::dynamics
