// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/crank_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kScaleRadius = 0.05;  // of gyration, where there is no mass [m]

double root_of(const CrankBody& crank, const char* what, double inertia) {
  if (!(inertia > 0.0) || !std::isfinite(inertia))
    throw InputError(fmt::format("{}: crank: {}: found {:g}, expected a positive number",
                                 crank.where, what, inertia));
  return std::sqrt(inertia);
}

}  // namespace

ModalBody make_crank_body(const CrankBody& crank) {
  const int n = (crank.in_bearings ? 4 : 0) + (crank.is_free ? 1 : 0);
  Eigen::VectorXd root(n);
  ModalBody body;
  body.name = CrankBody::kName;
  body.rigid = Eigen::MatrixXd::Zero(n, 6);
  body.is_rotation.assign(n, 1);
  if (crank.in_bearings) {
    const double mass = root_of(crank, "mass", crank.mass);
    const double diametral = root_of(crank, "diametral moment of inertia", crank.diametral);
    root.head<4>() << mass, mass, diametral, diametral;
    constexpr int kMotion[] = {1, 2, 4, 5};  // y, z, ry, rz
    for (int k = 0; k < 4; ++k) body.rigid(k, kMotion[k]) = root(k);
    body.is_rotation[CrankBody::kY] = body.is_rotation[CrankBody::kZ] = 0;
    body.mass = crank.mass;
  }
  if (crank.is_free) {
    root(n - 1) = root_of(crank, "polar moment of inertia", crank.polar);
    body.rigid(n - 1, 3) = root(n - 1);
    if (!crank.in_bearings) body.mass = crank.polar / (kScaleRadius * kScaleRadius);
  }
  body.shapes = root.cwiseInverse().asDiagonal();
  body.omega_squared = body.damping = Eigen::VectorXd::Zero(n);
  body.inertia = Eigen::VectorXd::Ones(n);
  body.rigid_modes = n;
  return body;
}

}  // namespace clatter::dynamics
