// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/far_harmonics.hpp"

#include <cmath>

#include "core/sound/complex_lu.hpp"
#include "core/sound/far_field.hpp"
#include "core/sound/spherical_harmonics.hpp"

namespace clatter::sound {
namespace {

/// The point about which source and image are nearest together.
Eigen::Vector3d far_centre(const Surface& surface, const Space& space) {
  if (!space.ground) return surface.middle;
  return surface.middle - space.ground->height(surface.middle) * space.ground->normal;
}

/// exp(-i k e . centre) of each direction, which moves the origin of F.
Eigen::VectorXcd moved_origin(const RowMatrix& unit, double k, const Eigen::Vector3d& centre) {
  const Eigen::VectorXd along = unit * centre;
  return along.unaryExpr([k](double distance) { return std::polar(1.0, -k * distance); });
}

}  // namespace

Eigen::MatrixXcd node_flow(const Surface& surface, const Eigen::MatrixXcd& velocity) {
  Eigen::MatrixXcd flow = Eigen::MatrixXcd::Zero(surface.node_count(), velocity.cols());
  for (Eigen::Index f = 0; f < surface.face_count(); ++f) {
    const Eigen::RowVectorXcd sum = velocity.middleRows(3 * f, 3).colwise().sum();
    for (int a = 0; a < 3; ++a)
      flow.row(surface.triangles(f, a)) +=
          surface.face_area[f] / 12.0 * (velocity.row(3 * f + a) + sum);
  }
  return flow;
}

FarHarmonics far_harmonics(const Surface& surface, const Space& space,
                           const BoundaryEquations& equations) {
  const double f = equations.frequency_hz(), k = space.fluid.wavenumber(f);
  const Directions sphere = power_directions(surface, space, f);
  const FarRows rows = far_rows(surface, space, f, sphere.unit);
  FarHarmonics out{power_degree(surface, space, f), far_centre(surface, space), {}};
  const Eigen::VectorXcd weight =
      sphere.weight.cwiseProduct(moved_origin(sphere.unit, k, out.centre));
  const Eigen::MatrixXcd onto = weight.asDiagonal() * spherical_harmonics(sphere.unit, out.degree);
  const Eigen::MatrixXcd of_pressure = rows_product(rows.of_pressure.transpose(), onto);
  const Eigen::MatrixXcd means = node_means(surface, rows.of_velocity);
  Eigen::MatrixXcd of_flow = equations.adjoint_flow(of_pressure);
  of_flow += rows_product(means.transpose(), onto);
  out.of_flow = of_flow.transpose();
  return out;
}

double power_of_far_field(const Space& space) {
  return (space.ground ? 0.5 : 1.0) / space.fluid.impedance();
}

}  // namespace clatter::sound
