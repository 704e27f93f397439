// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/boundary_equations.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/sound/boundary_matrices.hpp"

namespace clatter::sound {
namespace {

// Burton and Miller's matrices have conditions of some hundreds; from here a third of the digits
// is lost to the shape of the mesh.
constexpr double kHighestCondition = 1e10;

BoundaryMatrices checked_matrices(const Surface& surface, const Space& space, double frequency_hz) {
  if (!(frequency_hz > 0.0) || !std::isfinite(frequency_hz))
    throw InputError(
        fmt::format("radiation: found a frequency of {:g} Hz, expected more than 0", frequency_hz));
  const double k = space.fluid.wavenumber(frequency_hz);
  return boundary_matrices(surface, space, k, burton_miller_coupling(surface, k));
}

void check_motion(const Surface& surface, const Eigen::MatrixXcd& velocity) {
  if (velocity.rows() != 3 * surface.face_count())
    throw InputError(
        fmt::format("radiation: found {} normal velocities, expected one a corner of each face, {}",
                    velocity.rows(), 3 * surface.face_count()));
  if (!velocity.allFinite())
    throw InputError("radiation: found a normal velocity that is not finite");
}

}  // namespace

BoundaryEquations::BoundaryEquations(const Surface& surface, const Space& space,
                                     double frequency_hz)
    : surface_(surface),
      frequency_hz_(frequency_hz),
      // dp/dn = -i omega rho v_n = -i k rho c v_n.
      slope_(0.0, -space.fluid.wavenumber(frequency_hz) * space.fluid.impedance()),
      lu_([&] {
        BoundaryMatrices matrices = checked_matrices(surface, space, frequency_hz);
        B_transposed_ = std::move(matrices.B_transposed);
        return std::move(matrices.A_transposed);
      }()) {
  if (!(lu_.condition() < kHighestCondition))
    throw NumericsError(fmt::format(
        "radiation at {:g} Hz: found a matrix with condition {:.3g}, expected less than {:g}: "
        "improve the shape of the surface's faces",
        frequency_hz, lu_.condition(), kHighestCondition));
}

SurfaceState BoundaryEquations::radiate(const Eigen::MatrixXcd& velocity) const {
  check_motion(surface_, velocity);
  Eigen::MatrixXcd pressure = lu_.solve(slope_ * rows_product(B_transposed_, velocity));
  return {frequency_hz_, velocity, std::move(pressure), lu_.condition()};
}

Eigen::MatrixXcd BoundaryEquations::adjoint_flow(Eigen::MatrixXcd of_pressure) const {
  const Eigen::MatrixXcd of_equations = lu_.solve_transposed(std::move(of_pressure));
  const Eigen::MatrixXcd means = node_means(surface_, B_transposed_);
  return slope_ * rows_product(means.transpose(), of_equations);
}

Eigen::MatrixXcd node_means(const Surface& surface, const Eigen::MatrixXcd& integrals) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(surface.node_count(), integrals.cols());
  Eigen::VectorXd area = Eigen::VectorXd::Zero(surface.node_count());
  for (Eigen::Index f = 0; f < surface.face_count(); ++f) {
    const Eigen::RowVectorXcd sum = integrals.middleRows(3 * f, 3).colwise().sum();
    for (int a = 0; a < 3; ++a) {
      // The inverse of the integrals of N_a N_b is 12 / A on the diagonal less 3 / A everywhere.
      out.row(surface.triangles(f, a)) += 12.0 * integrals.row(3 * f + a) - 3.0 * sum;
      area[surface.triangles(f, a)] += surface.face_area[f];
    }
  }
  return area.cwiseInverse().asDiagonal() * out;
}

}  // namespace clatter::sound
