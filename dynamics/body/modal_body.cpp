// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/modal_body.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/dense/least_squares.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rotations and displacements differ by orders of magnitude; the scale 1/sqrt(M_ii) balances them.
VectorXd mass_scale(const rom::ReducedModel& model) {
  VectorXd scale(model.size());
  for (int i = 0; i < model.size(); ++i) {
    const double m = model.M_rr(i, i);
    if (!(m > 0.0)) {
      throw NumericsError(
          fmt::format("{}: M_rr({},{}) is {}, expected a positive mass", model.name, i, i, m));
    }
    scale(i) = 1.0 / std::sqrt(m);
  }
  return scale;
}

/// M-orthonormal basis of the rigid motions that do not strain the body; n x k, k <= 6.
MatrixXd free_motions(const MatrixXd& M, const MatrixXd& K, const MatrixXd& rigid) {
  if (rigid.cols() == 0) return MatrixXd(M.rows(), 0);
  const MatrixXd mass = rigid.transpose() * M * rigid;
  const MatrixXd stiffness = rigid.transpose() * K * rigid;
  const dense::Eigenpairs solved = dense::symmetric_eigen(stiffness, mass);
  if (!solved.ok) return MatrixXd(M.rows(), 0);
  const MatrixXd candidates = rigid * solved.vectors;
  // A motion is free when K r is at rounding level; the certificate of the model requires 1e-10.
  constexpr double kFree = 1e-8;
  int count = 0;
  MatrixXd kept(M.rows(), candidates.cols());
  for (int j = 0; j < candidates.cols(); ++j) {
    const VectorXd r = candidates.col(j);
    if ((K * r).norm() <= kFree * K.norm() * r.norm()) kept.col(count++) = r;
  }
  return kept.leftCols(count);
}

struct Spectrum {
  MatrixXd shapes;
  VectorXd omega_squared;
};

Spectrum elastic_spectrum(const std::string& name, const MatrixXd& M, const MatrixXd& K,
                          const MatrixXd& free) {
  // A typical squared frequency: the free motions get its negative and come first.
  const double shift = K.trace() / M.trace();
  const MatrixXd Mr = M * free;
  const MatrixXd shifted = K - shift * Mr * Mr.transpose();
  const dense::Eigenpairs solved = dense::symmetric_eigen(shifted, M);
  if (!solved.ok) {
    throw NumericsError(
        fmt::format("{}: the eigenproblem of (K_rr, M_rr) failed, M_rr is probably "
                    "not positive definite",
                    name));
  }
  const auto n = M.rows(), k = free.cols();
  Spectrum result{MatrixXd(n, n), VectorXd::Zero(n)};
  result.shapes.leftCols(k) = free;
  result.shapes.rightCols(n - k) = solved.vectors.rightCols(n - k);
  result.omega_squared.tail(n - k) = solved.values.tail(n - k);
  result.shapes.rightCols(n - k) -= free * (Mr.transpose() * result.shapes.rightCols(n - k));
  if (n > k && !(result.omega_squared(k) > 0.0)) {
    throw NumericsError(
        fmt::format("{}: elastic eigenvalue {} 1/s2 after {} rigid modes, expected a positive one",
                    name, result.omega_squared(k), k));
  }
  return result;
}

std::vector<int32_t> rotations(const rom::ReducedModel& model) {
  std::vector<int32_t> flags(static_cast<size_t>(model.dof_count()), 0);
  for (const auto& [name, set] : model.sets) {
    for (size_t i = 0; i < set.dofs.size(); ++i) {
      flags[set.dofs[i]] = set.is_rotation[i];
    }
  }
  return flags;
}

}  // namespace

Wrench unit_wrench(int k, const Eigen::Vector3d& point) { return moved(Wrench::Unit(k), point); }

Wrench moved(const Wrench& wrench, const Eigen::Vector3d& point) {
  Wrench result = wrench;
  result.tail<3>() += point.cross(wrench.head<3>());
  return result;
}

VectorXd ModalBody::force_of(const Wrench& wrench) const {
  const dense::LeastSquares force = dense::least_squares(rigid.transpose(), wrench);
  if (force.rank < 6) {
    throw NumericsError(
        fmt::format("{}: found {} independent rigid motions, expected 6 for a force on its rigid "
                    "frame",
                    name, force.rank));
  }
  return force.X;
}

ModalBody make_modal_body(const rom::ReducedModel& model, const ModalBodyOptions& options) {
  const VectorXd scale = mass_scale(model);
  const MatrixXd M = scale.asDiagonal() * model.M_rr * scale.asDiagonal();
  const MatrixXd K = scale.asDiagonal() * model.K_rr * scale.asDiagonal();
  const MatrixXd rigid = scale.cwiseInverse().asDiagonal() * model.rigid;
  const MatrixXd free = free_motions(M, K, rigid);

  Spectrum spectrum;
  if (options.elastic) {
    spectrum = elastic_spectrum(model.name, M, K, free);
  } else {
    if (free.cols() != 6) {
      throw NumericsError(
          fmt::format("{}: found model = \"rigid\", but only {} of its six rigid motions are free",
                      model.name, free.cols()));
    }
    spectrum = {free, VectorXd::Zero(6)};
  }
  ModalBody body;
  body.name = model.name;
  body.shapes = scale.asDiagonal() * spectrum.shapes;
  if (model.combined.rows() > 0) body.combined = model.combined * body.shapes;
  body.omega_squared = spectrum.omega_squared;
  body.rigid_modes = static_cast<int>(free.cols());
  body.damping = model.damping_rates(body.omega_squared, body.shapes);
  body.damping.head(body.rigid_modes).setZero();
  body.inertia = VectorXd::Ones(body.modes());
  if (options.mode_limit_hz > 0.0) {
    const double limit = std::pow(2.0 * std::numbers::pi * options.mode_limit_hz, 2);
    body.inertia = (body.omega_squared.array() <= limit).cast<double>();
  }
  if (model.inertia_force.rows() > 0)
    body.rigid = body.shapes.transpose() * model.inertia_force;
  else
    body.rigid = spectrum.shapes.transpose() * (M * rigid);
  body.is_rotation = rotations(model);
  body.mass = model.mass.mass;
  return body;
}

}  // namespace clatter::dynamics
