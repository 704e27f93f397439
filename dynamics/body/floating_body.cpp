// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/floating_body.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Matrix3X mean_of(const ElasticShapes& shapes) {
  Matrix3X mean(3, shapes.invariants.size());
  for (int k = 0; k < 3; ++k) mean.row(k) = shapes.invariants.first[k].transpose() / shapes.mass;
  return mean;
}

/// The invariants about the centre of mass, with shapes N - mean.
rom::InertiaInvariants centred(const ElasticShapes& shapes) {
  rom::InertiaInvariants out = shapes.invariants;
  const auto& first = shapes.invariants.first;
  for (size_t k = 0; k < 3; ++k) {
    out.first[k].setZero();
    for (size_t l = 0; l < 3; ++l) {
      out.moment[3 * l + k] -= shapes.centre(static_cast<int>(l)) * first[k];
      out.product[3 * k + l] -= first[k] * first[l].transpose() / shapes.mass;
    }
  }
  out.place -= shapes.mass * shapes.centre * shapes.centre.transpose();
  return out;
}

VectorXd or_zero(const VectorXd& values, Eigen::Index size) {
  return values.size() > 0 ? values : VectorXd::Zero(size);
}

/// The coordinates of a spatial body with n more for its modes.
ModalBody with_modes(ModalBody body, const VectorXd& omega_squared, const VectorXd& damping) {
  const Eigen::Index n = omega_squared.size(), all = kSpatial + n;
  body.shapes.conservativeResizeLike(MatrixXd::Zero(kSpatial, all));
  body.rigid.conservativeResizeLike(MatrixXd::Zero(all, 6));
  for (VectorXd* values : {&body.omega_squared, &body.damping, &body.inertia, &body.state_scale,
                           &body.eta_start, &body.v_start})
    values->conservativeResizeLike(VectorXd::Zero(all));
  body.omega_squared.tail(n) = omega_squared;
  body.damping.tail(n) = damping;
  body.inertia.tail(n).setOnes();
  body.state_scale.tail(n).setOnes();
  body.state_error.resize(all, StateError::kNone);
  return body;
}

}  // namespace

Matrix3X FloatingBody::shape(const Matrix3X& N) const { return (N - mean) * W; }

FloatingBody make_floating_body(const std::string& name, const ElasticShapes& shapes,
                                const ElasticStart& start) {
  FloatingBody floating;
  floating.centre = shapes.centre;
  floating.mean = mean_of(shapes);
  const rom::InertiaInvariants about = centred(shapes);
  const MatrixXd M = about.product[0] + about.product[4] + about.product[8];
  const dense::Eigenpairs modes = dense::symmetric_eigen(shapes.stiffness, M);
  if (!modes.ok || !(modes.values.minCoeff() > 0.0))
    throw NumericsError(
        fmt::format("{}: stiffness and mass of its {} shapes: expected positive definite matrices",
                    name, M.rows()));
  floating.W = modes.vectors;
  const rom::InertiaInvariants invariants = about.in(floating.W);

  const Eigen::Index n = M.rows();
  const VectorXd q = or_zero(start.q, n), rate = or_zero(start.rate, n);
  const VectorXd eta = floating.W.transpose() * (M * q), v = floating.W.transpose() * (M * rate);
  const auto frame = std::make_shared<SpatialFrame>(invariants, quaternion_of(start.frame.rotation),
                                                    start.frame.spin);
  const VectorXd inertia =
      dense::symmetric_eigen(frame->inertia(VectorXd::Zero(n)), dense::EigenParts::kValues).values;
  const Eigen::Matrix3d A = start.frame.rotation.normalized().toRotationMatrix();
  const Vector3d to_centre = shapes.centre + floating.mean * q;
  SpatialMotion motion = start.frame;
  motion.centre += A * to_centre;
  motion.velocity += A * (start.frame.spin.cross(to_centre) + floating.mean * rate);
  floating.body =
      with_modes(spatial_coordinates(name, shapes.mass, inertia.minCoeff(), frame, motion),
                 modes.values, or_zero(shapes.damping, n));
  floating.body.eta_start.tail(n) = eta;
  floating.body.v_start.tail(n) = v;
  floating.body.eta_start.segment<3>(kMomentum) = A * frame->momentum(eta, v, start.frame.spin);
  return floating;
}

ElasticShapes mean_axis_shapes(const ModalBody& free, const rom::InertiaInvariants& invariants) {
  if (free.rigid_modes != 6 || free.rigid.rows() != free.modes())
    throw InputError(
        fmt::format("{}: found {} rigid modes, expected the 6 of a body without "
                    "supports, which moves freely",
                    free.name, free.rigid_modes));
  if (invariants.empty())
    throw InputError(fmt::format(
        "{}: found no inertia invariants, expected those of a body that turns: condense "
        "the part with inertia_invariants = true",
        free.name));
  const int n = free.modes() - 6;
  ElasticShapes shapes;
  // The mass matrix of the six rigid motions about the origin.
  const Eigen::Matrix<double, 6, 6> M = free.rigid.transpose() * free.rigid;
  shapes.mass = M(0, 0);
  shapes.centre = Vector3d(M(1, 5), -M(0, 5), M(0, 4)) / shapes.mass;
  shapes.invariants = invariants.in(free.shapes.rightCols(n));
  shapes.stiffness = free.omega_squared.tail(n).asDiagonal();
  shapes.damping = free.damping.tail(n);
  return shapes;
}

}  // namespace clatter::dynamics
