// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/rigid_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

void require_positive(const std::string& name, const char* what, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw InputError(
        fmt::format("{}: {}: found {}, expected a positive number", name, what, value));
}

}  // namespace

ModalBody make_planar_body(const std::string& name, double mass, double inertia,
                           const PlanarMotion& start) {
  require_positive(name, "mass", mass);
  require_positive(name, "moment of inertia", inertia);
  const Eigen::Vector3d root = Eigen::Vector3d(mass, mass, inertia).cwiseSqrt();
  ModalBody body;
  body.name = name;
  body.shapes = root.cwiseInverse().asDiagonal();
  body.omega_squared = body.damping = Eigen::VectorXd::Zero(3);
  body.inertia = Eigen::VectorXd::Ones(3);
  body.rigid = Eigen::MatrixXd::Zero(3, 6);
  body.rigid(0, 0) = body.rigid(1, 1) = root(0);
  body.rigid(2, 5) = root(2);
  body.is_rotation = {0, 0, 1};
  body.rigid_modes = 3;
  body.mass = mass;
  const Eigen::Vector3d at(start.centre.x(), start.centre.y(), start.angle);
  const Eigen::Vector3d rate(start.velocity.x(), start.velocity.y(), start.spin);
  body.eta_start = root.cwiseProduct(at);
  body.v_start = root.cwiseProduct(rate);
  return body;
}

ModalBody make_sliding_body(const std::string& name, double mass, const Eigen::Vector3d& axis,
                            double velocity) {
  require_positive(name, "mass", mass);
  const double root = std::sqrt(mass);
  ModalBody body;
  body.name = name;
  body.shapes = Eigen::MatrixXd::Constant(1, 1, 1.0 / root);
  body.omega_squared = body.damping = Eigen::VectorXd::Zero(1);
  body.inertia = Eigen::VectorXd::Ones(1);
  body.rigid = Eigen::MatrixXd::Zero(1, 6);
  body.rigid.leftCols<3>() = root * axis.transpose();
  body.is_rotation = {0};
  body.rigid_modes = 1;
  body.mass = mass;
  body.eta_start = Eigen::VectorXd::Zero(1);
  body.v_start = Eigen::VectorXd::Constant(1, root * velocity);
  return body;
}

ModalBody make_spatial_body(const std::string& name, double mass, const Eigen::Vector3d& inertia,
                            const SpatialMotion& start) {
  require_positive(name, "mass", mass);
  for (int k = 0; k < 3; ++k) {
    require_positive(name, "principal moment of inertia", inertia(k));
    if (2.0 * inertia(k) > inertia.sum() * (1.0 + 1e-12))
      throw InputError(
          fmt::format("{}: principal moments of inertia: found {:.6g} above the sum of the other "
                      "two, {:.6g} kg m2: no body has them",
                      name, inertia(k), inertia.sum() - inertia(k)));
  }
  return spatial_coordinates(
      name, mass, inertia.minCoeff(),
      std::make_shared<SpatialFrame>(inertia.asDiagonal().toDenseMatrix(),
                                     quaternion_of(start.rotation), start.spin),
      start);
}

ModalBody spatial_coordinates(const std::string& name, double mass, double least,
                              std::shared_ptr<SpatialFrame> frame, const SpatialMotion& start) {
  const double root = std::sqrt(mass);
  ModalBody body;
  body.name = name;
  body.shapes = Eigen::MatrixXd::Identity(kSpatial, kSpatial);
  body.shapes.topLeftCorner<3, 3>() /= root;
  body.omega_squared = Eigen::VectorXd::Zero(kSpatial);
  body.damping = Eigen::VectorXd::Zero(kSpatial);
  body.damping.tail(kSpatial - kTurn).setOnes();
  body.inertia = Eigen::VectorXd::Zero(kSpatial);
  body.inertia.head<3>().setOnes();
  body.rigid = Eigen::MatrixXd::Zero(kSpatial, 6);
  body.rigid.topLeftCorner<3, 3>() = root * Eigen::Matrix3d::Identity();
  body.is_rotation.assign(kSpatial, 0);
  body.rigid_modes = 3;
  body.mass = mass;
  body.state_error.assign(kSpatial, StateError::kNone);
  body.state_scale = Eigen::VectorXd::Ones(kSpatial);
  // A change of p by d is a rotation by 2 d, one of L by d an angular velocity of at most d /
  // least.
  for (int k = kTurn; k < kMomentum; ++k) {
    body.state_error[k] = StateError::kRotation;
    body.state_scale(k) = 0.5;
  }
  for (int k = kMomentum; k < kSpatial; ++k) {
    body.state_error[k] = StateError::kSpin;
    body.state_scale(k) = least;
  }
  body.eta_start = body.v_start = Eigen::VectorXd::Zero(kSpatial);
  body.eta_start.head<3>() = root * start.centre;
  body.eta_start(kTurn) = 1.0;
  body.v_start.head<3>() = root * start.velocity;
  body.eta_start.segment<3>(kMomentum) = frame->free().momentum();
  body.frame = std::move(frame);
  return body;
}

Eigen::Vector4d quaternion_of(const Eigen::Quaterniond& rotation) {
  const Eigen::Quaterniond q = rotation.normalized();
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace clatter::dynamics
