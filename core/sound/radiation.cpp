// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/radiation.hpp"

#include "core/sound/boundary_equations.hpp"

namespace clatter::sound {
namespace {

/// int N_a v_n dS at each corner: mass times velocity, 3 n_f x m.
Eigen::MatrixXcd face_integrals(const Surface& surface, const Eigen::MatrixXcd& velocity) {
  Eigen::MatrixXcd out(velocity.rows(), velocity.cols());
  for (Eigen::Index f = 0; f < surface.face_count(); ++f) {
    const auto corners = velocity.middleRows(3 * f, 3);
    const Eigen::RowVectorXcd sum = corners.colwise().sum();
    out.middleRows(3 * f, 3) = surface.face_area[f] / 12.0 * (corners.rowwise() + sum);
  }
  return out;
}

/// Pressures at the corners of the faces, 3 n_f x m.
Eigen::MatrixXcd corner_pressure(const Surface& surface, const SurfaceState& state) {
  Eigen::MatrixXcd out(3 * surface.face_count(), state.pressure.cols());
  for (Eigen::Index f = 0; f < surface.face_count(); ++f)
    for (int a = 0; a < 3; ++a) out.row(3 * f + a) = state.pressure.row(surface.triangles(f, a));
  return out;
}

}  // namespace

Eigen::MatrixXcd at_corners(const Eigen::MatrixXcd& face_velocity) {
  Eigen::MatrixXcd out(3 * face_velocity.rows(), face_velocity.cols());
  for (Eigen::Index f = 0; f < face_velocity.rows(); ++f)
    out.middleRows(3 * f, 3).rowwise() = face_velocity.row(f);
  return out;
}

SurfaceState radiate(const Surface& surface, const Space& space, double frequency_hz,
                     const Eigen::MatrixXcd& velocity) {
  return BoundaryEquations(surface, space, frequency_hz).radiate(velocity);
}

Eigen::MatrixXcd face_pressure(const Surface& surface, const SurfaceState& state) {
  Eigen::MatrixXcd mean(surface.face_count(), state.pressure.cols());
  for (Eigen::Index f = 0; f < surface.face_count(); ++f)
    mean.row(f) =
        (state.pressure.row(surface.triangles(f, 0)) + state.pressure.row(surface.triangles(f, 1)) +
         state.pressure.row(surface.triangles(f, 2))) /
        3.0;
  return mean;
}

Eigen::VectorXd surface_power(const Surface& surface, const SurfaceState& state) {
  const Eigen::MatrixXcd flux = face_integrals(surface, state.velocity);
  return 0.5 * corner_pressure(surface, state)
                   .cwiseProduct(flux.conjugate())
                   .colwise()
                   .sum()
                   .real()
                   .transpose();
}

Eigen::VectorXd radiation_efficiency(const Surface& surface, const Fluid& fluid,
                                     const SurfaceState& state, const Eigen::VectorXd& power) {
  const Eigen::MatrixXcd flux = face_integrals(surface, state.velocity);
  const Eigen::VectorXd squares =
      state.velocity.conjugate().cwiseProduct(flux).colwise().sum().real().transpose();
  return power.cwiseQuotient(0.5 * fluid.impedance() * squares);
}

Eigen::MatrixXd surface_resistance(const Surface& surface, const SurfaceState& state) {
  const Eigen::MatrixXd flux = face_integrals(surface, state.velocity).real();
  const Eigen::MatrixXd R = flux.transpose() * corner_pressure(surface, state).real();
  return 0.5 * (R + R.transpose());
}

}  // namespace clatter::sound
