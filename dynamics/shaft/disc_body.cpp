// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/disc_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

void require_positive(const std::string& name, const char* what, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw InputError(
        fmt::format("{}: {}: found {:g}, expected a positive number", name, what, value));
}

/// A body whose coordinates have the inertias root^2 and move it as the columns of `rigid` say.
ModalBody free_body(const std::string& name, const Eigen::VectorXd& root, double mass) {
  const Eigen::Index n = root.size();
  ModalBody body;
  body.name = name;
  body.shapes = root.cwiseInverse().asDiagonal();
  body.omega_squared = body.damping = Eigen::VectorXd::Zero(n);
  body.inertia = Eigen::VectorXd::Ones(n);
  body.rigid = Eigen::MatrixXd::Zero(n, 6);
  body.mass = mass;
  body.eta_start = body.v_start = Eigen::VectorXd::Zero(n);
  return body;
}

}  // namespace

ModalBody make_disc_body(const std::string& name, const DiscInertia& inertia, const ShaftAxes& axes,
                         const DiscStart& start) {
  require_positive(name, "mass", inertia.mass);
  require_positive(name, "polar moment of inertia", inertia.polar);
  require_positive(name, "diametral moment of inertia", inertia.diametral);
  Eigen::VectorXd root(6);
  root.head<3>().setConstant(std::sqrt(inertia.mass));
  root.tail<3>().setConstant(std::sqrt(inertia.diametral));
  const int turn = 3 + axes.axis;
  root(turn) = std::sqrt(inertia.polar);
  ModalBody body = free_body(name, root, inertia.mass);
  body.rigid.diagonal() = root;
  body.is_rotation = {0, 0, 0, 1, 1, 1};
  // The large angle is not a small motion of the body as a rigid body.
  body.rigid_modes = 5;
  body.eta_start(turn) = root(turn) * start.angle;
  body.v_start(turn) = root(turn) * start.speed;
  return body;
}

ModalBody make_turning_body(const std::string& name, const DiscInertia& inertia,
                            const ShaftAxes& axes, const DiscStart& start) {
  require_positive(name, "mass", inertia.mass);
  require_positive(name, "polar moment of inertia", inertia.polar);
  const Eigen::VectorXd root = Eigen::VectorXd::Constant(1, std::sqrt(inertia.polar));
  ModalBody body = free_body(name, root, inertia.mass);
  body.rigid(0, 3 + axes.axis) = root(0);
  body.is_rotation = {1};
  body.eta_start = root * start.angle;
  body.v_start = root * start.speed;
  return body;
}

}  // namespace clatter::dynamics
