// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/far_field.hpp"

#include <cmath>
#include <numbers>

#include "core/base/threads.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sound/complex_lu.hpp"
#include "core/sound/facet.hpp"

namespace clatter::sound {
namespace {

constexpr double kPi = std::numbers::pi;

/// Points and weights of Gauss on [-1, 1]: eigenpairs of a tridiagonal matrix (Golub and Welsch
/// 1969). Row 0: points, row 1: weights.
Eigen::MatrixXd gauss_points(int n) {
  Eigen::VectorXd below(std::max(n - 1, 0));
  for (int i = 1; i < n; ++i) below[i - 1] = i / std::sqrt(4.0 * i * i - 1.0);
  const dense::Eigenpairs eigen = dense::tridiagonal_eigen(Eigen::VectorXd::Zero(n), below);
  Eigen::MatrixXd out(2, n);
  out.row(0) = eigen.values.transpose();
  out.row(1) = 2.0 * eigen.vectors.row(0).cwiseAbs2();
  return out;
}

/// The parts of F that pressures at nodes and velocities at corners (over i omega rho) contribute,
/// in one direction.
struct FarRow {
  Eigen::VectorXcd pressure;  // n_v
  Eigen::VectorXcd velocity;  // 3 n_f
};

void add_facet(double k, const Eigen::Vector3d& e, const PreparedFacet& y, Eigen::Index face,
               bool same_surface, FarRow& row) {
  const TriangleRule& rule = six_points();
  Eigen::Vector3cd sum = Eigen::Vector3cd::Zero();
  for (Eigen::Index q = 0; q < rule.weight.size(); ++q) {
    const Eigen::Vector3d shape = rule.shape.col(q);
    const double phase = k * e.dot(y.facet.corners * shape);
    sum += rule.weight[q] * y.facet.area * Complex(std::cos(phase), std::sin(phase)) * shape;
  }
  const Complex slope(0.0, k * e.dot(y.facet.normal) / (4.0 * kPi));
  for (int b = 0; b < 3; ++b) {
    row.pressure[y.nodes[b]] += slope * sum[b];
    row.velocity[3 * face + corner_of_face(b, same_surface)] += sum[b] / (4.0 * kPi);
  }
}

/// conj(F) F over the sphere or its upper half.
double sphere_share(const Space& space) { return space.ground ? 0.5 : 1.0; }

}  // namespace

Directions sphere_directions(int degree) {
  const int heights = degree + 1, around = 2 * degree + 2;
  const Eigen::MatrixXd gauss = gauss_points(heights);
  Directions out{RowMatrix(heights * around, 3), Eigen::VectorXd(heights * around)};
  for (int i = 0; i < heights; ++i)
    for (int j = 0; j < around; ++j) {
      const double z = gauss(0, i), angle = 2.0 * kPi * j / around;
      const double across = std::sqrt(1.0 - z * z);
      out.unit.row(i * around + j) << across * std::cos(angle), across * std::sin(angle), z;
      out.weight[i * around + j] = gauss(1, i) * 2.0 * kPi / around;
    }
  return out;
}

int power_degree(const Surface& surface, const Space& space, double frequency_hz) {
  // With an image the sources fill a sphere about the foot of the body's middle.
  const double height = space.ground ? space.ground->height(surface.middle) : 0.0;
  const double size = space.fluid.wavenumber(frequency_hz) * (surface.radius + height);
  return static_cast<int>(std::ceil(size + 4.0 * std::cbrt(size) + 2.0));
}

Directions power_directions(const Surface& surface, const Space& space, double frequency_hz) {
  return sphere_directions(power_degree(surface, space, frequency_hz));
}

FarRows far_rows(const Surface& surface, const Space& space, double frequency_hz,
                 const RowMatrix& unit) {
  const double k = space.fluid.wavenumber(frequency_hz);
  const std::vector<PreparedFacet> facets = prepared_facets(surface);
  const std::vector<PreparedFacet> images = image_facets(surface, space);
  const Eigen::Index n_v = surface.node_count(), n_f = surface.face_count();
  const Complex slope(0.0, k * space.fluid.impedance());
  FarRows out{Eigen::MatrixXcd(n_v, unit.rows()), Eigen::MatrixXcd(3 * n_f, unit.rows())};
  parallel_pieces(unit.rows(), [&](int64_t begin, int64_t end) {
    FarRow row;
    for (int64_t d = begin; d < end; ++d) {
      row.pressure.setZero(n_v);
      row.velocity.setZero(3 * n_f);
      const Eigen::Vector3d e = unit.row(d);
      for (size_t y = 0; y < facets.size(); ++y)
        add_facet(k, e, facets[y], static_cast<Eigen::Index>(y), true, row);
      for (size_t y = 0; y < images.size(); ++y)
        add_facet(k, e, images[y], static_cast<Eigen::Index>(y), false, row);
      out.of_pressure.col(d) = row.pressure;
      out.of_velocity.col(d) = slope * row.velocity;
    }
  });
  return out;
}

Eigen::MatrixXcd far_field(const Surface& surface, const Space& space, const SurfaceState& state,
                           const RowMatrix& unit) {
  const FarRows rows = far_rows(surface, space, state.frequency_hz, unit);
  return rows_product(rows.of_pressure, state.pressure) +
         rows_product(rows.of_velocity, state.velocity);
}

Eigen::VectorXd far_power(const Surface& surface, const Space& space, const SurfaceState& state) {
  const Directions sphere = power_directions(surface, space, state.frequency_hz);
  const Eigen::MatrixXcd F = far_field(surface, space, state, sphere.unit);
  return sphere_share(space) / (2.0 * space.fluid.impedance()) *
         (F.cwiseAbs2().transpose() * sphere.weight);
}

Eigen::MatrixXd far_resistance(const Surface& surface, const Space& space,
                               const SurfaceState& state) {
  const Directions sphere = power_directions(surface, space, state.frequency_hz);
  const Eigen::MatrixXcd F = far_field(surface, space, state, sphere.unit);
  const Eigen::MatrixXcd weighted = sphere.weight.cwiseSqrt().asDiagonal() * F;
  const Eigen::MatrixXd real = weighted.real(), imag = weighted.imag();
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(F.cols(), F.cols());
  R.selfadjointView<Eigen::Lower>().rankUpdate(real.transpose());
  R.selfadjointView<Eigen::Lower>().rankUpdate(imag.transpose());
  R *= sphere_share(space) / space.fluid.impedance();
  return R.selfadjointView<Eigen::Lower>();
}

}  // namespace clatter::sound
