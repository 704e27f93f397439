// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/radiation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/sound/boundary_matrices.hpp"
#include "core/sound/complex_lu.hpp"

namespace clatter::sound {
namespace {

// Burton and Miller's matrices have conditions of some hundreds; from here a third of the digits
// is lost to the shape of the mesh.
constexpr double kHighestCondition = 1e10;

void check_motion(const Surface& surface, double frequency_hz, const Eigen::MatrixXcd& velocity) {
  if (!(frequency_hz > 0.0) || !std::isfinite(frequency_hz))
    throw InputError(
        fmt::format("radiation: found a frequency of {:g} Hz, expected more than 0", frequency_hz));
  if (velocity.rows() != 3 * surface.face_count())
    throw InputError(
        fmt::format("radiation: found {} normal velocities, expected one a corner of each face, {}",
                    velocity.rows(), 3 * surface.face_count()));
  if (!velocity.allFinite())
    throw InputError("radiation: found a normal velocity that is not finite");
}

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
  check_motion(surface, frequency_hz, velocity);
  const double k = space.fluid.wavenumber(frequency_hz);
  BoundaryMatrices matrices =
      boundary_matrices(surface, space, k, burton_miller_coupling(surface, k));
  // dp/dn = -i omega rho v_n = -i k rho c v_n.
  const Complex slope(0.0, -k * space.fluid.impedance());
  Eigen::MatrixXcd right = slope * rows_product(matrices.B_transposed, velocity);
  matrices.B_transposed.resize(0, 0);
  ComplexSolution solution = solve_dense(std::move(matrices.A_transposed), std::move(right));
  if (!(solution.condition < kHighestCondition) || !solution.X.allFinite())
    throw NumericsError(fmt::format(
        "radiation at {:g} Hz: found a matrix with condition {:.3g}, expected less than {:g}: "
        "improve the shape of the surface's faces",
        frequency_hz, solution.condition, kHighestCondition));
  return {frequency_hz, velocity, std::move(solution.X), solution.condition};
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
