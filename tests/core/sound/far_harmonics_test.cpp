// SPDX-License-Identifier: GPL-3.0-or-later
// The far field per node flow: spherical harmonics, power, parts of a surface, directivity.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies.hpp"
#include "core/sound/far_field.hpp"
#include "core/sound/far_harmonics.hpp"
#include "core/sound/spherical_harmonics.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::sound {
namespace {

using namespace testing;

TEST(SphericalHarmonics, LowestAreConstantAndCoordinates) {
  const RowMatrix e = Eigen::RowVector3d(0.6, -0.48, 0.64);
  const Eigen::MatrixXd Y = spherical_harmonics(e, 2);
  EXPECT_NEAR(Y(0, 0), std::sqrt(1.0 / (4.0 * std::numbers::pi)), 1e-15);
  for (const auto& [column, axis] : {std::pair{1, 1}, {2, 2}, {3, 0}})  // m = -1, 0, 1: y, z, x
    EXPECT_NEAR(Y(0, column), std::sqrt(3.0 / (4.0 * std::numbers::pi)) * e(0, axis), 1e-15)
        << column;
  EXPECT_NEAR(Y(0, 4), std::sqrt(15.0 / (4.0 * std::numbers::pi)) * e(0, 0) * e(0, 1), 1e-15);
  EXPECT_NEAR(Y(0, 6), std::sqrt(5.0 / (16.0 * std::numbers::pi)) * (3.0 * e(0, 2) * e(0, 2) - 1.0),
              1e-15);
}

TEST(SphericalHarmonics, AreOrthonormalUnderTheQuadratureOfDirections) {
  constexpr int kDegree = 30;
  const Directions sphere = sphere_directions(kDegree);
  const Eigen::MatrixXd Y = spherical_harmonics(sphere.unit, kDegree);
  const Eigen::MatrixXd products = Y.transpose() * sphere.weight.asDiagonal() * Y;
  EXPECT_LT((products - Eigen::MatrixXd::Identity(Y.cols(), Y.cols())).cwiseAbs().maxCoeff(),
            1e-12);
}

/// R of P = 1/2 q^T R q from the far field per node flow.
Eigen::MatrixXd resistance(const Space& space, const FarHarmonics& far,
                           const Eigen::MatrixXcd& flow) {
  const Eigen::MatrixXcd F = far.of_flow * flow;
  return power_of_far_field(space) * (F.adjoint() * F).real();
}

/// A translation, a turn, swelling and a bending motion of a body, n_f x 4.
Eigen::MatrixXcd smooth_motions(const Surface& body) {
  Eigen::MatrixXcd v(body.face_count(), 4);
  for (Eigen::Index f = 0; f < body.face_count(); ++f) {
    const Eigen::Vector3d n = body.face_normal.row(f), x = body.face_centre.row(f);
    v.row(f) << n[0], x.cross(n)[1], 1.0, n[2] * std::cos(6.0 * x[0]);
  }
  return v;
}

/// Largest relative difference of the powers of smooth motions from those of far_power().
double power_difference(int levels, double k) {
  const Surface egg = bent_egg(levels);
  const BoundaryEquations equations(egg, kAir, frequency_of(k));
  const SurfaceState state = equations.radiate(at_corners(smooth_motions(egg)));
  const Eigen::VectorXd exact = far_power(egg, kAir, state);
  const Eigen::VectorXd found =
      0.5 * resistance(kAir, far_harmonics(egg, kAir, equations), node_flow(egg, state.velocity))
                .diagonal();
  return (found.cwiseQuotient(exact).array() - 1.0).abs().maxCoeff();
}

TEST(FarHarmonics, PowerPerNodeFlowDiffersFromThatOfTheDirectionsBySecondOrder) {
  for (double k : {0.5, 6.0}) {
    const double coarse = power_difference(1, k), fine = power_difference(2, k);
    EXPECT_LT(fine, 0.01) << k;
    EXPECT_GT(coarse / fine, 2.5) << k;
  }
}

TEST(FarHarmonics, SpheresHaveTheirEfficiency) {
  const Surface sphere = unit_sphere(2);
  Eigen::MatrixXcd v(sphere.face_count(), 2);
  v.col(0).setOnes();
  v.col(1) = sphere.face_normal.col(2).cast<Complex>();
  for (double ka : {0.05, 1.0, 6.0}) {
    const BoundaryEquations equations(sphere, kAir, frequency_of(ka));
    const SurfaceState state = equations.radiate(at_corners(v));
    const Eigen::VectorXd power = 0.5 * resistance(kAir, far_harmonics(sphere, kAir, equations),
                                                   node_flow(sphere, state.velocity))
                                            .diagonal();
    const Eigen::VectorXd sigma = radiation_efficiency(sphere, kAir.fluid, state, power);
    const double q = ka * ka;
    EXPECT_NEAR(sigma[0] / (q / (1 + q)), 1.0, 0.01) << ka;
    EXPECT_NEAR(sigma[1] / (q * q / (4 + q * q)), 1.0, 0.01) << ka;
  }
}

TEST(FarHarmonics, SumToTheFarFieldInEveryDirection) {
  // Far from the origin of coordinates, and without symmetry.
  Triangles egg = sphere_triangles(2);
  egg.nodes.col(0) *= 0.5;
  egg.nodes.rowwise() += Eigen::RowVector3d(4.0, -3.0, 2.0);
  const Surface body = closed_surface(egg.nodes, egg.faces);
  const double k = 3.0;
  const BoundaryEquations equations(body, kAir, frequency_of(k));
  const SurfaceState state = equations.radiate(at_corners(body.face_normal.col(0).cast<Complex>()));
  const FarHarmonics far = far_harmonics(body, kAir, equations);
  EXPECT_LT((far.centre - Eigen::Vector3d(4, -3, 2)).norm(), 1e-12);
  const RowMatrix e = sphere_directions(4).unit;
  const Eigen::VectorXcd found =
      spherical_harmonics(e, far.degree) * (far.of_flow * node_flow(body, state.velocity));
  const Eigen::VectorXcd exact = far_field(body, kAir, state, e);
  for (Eigen::Index d = 0; d < e.rows(); ++d) {
    const Complex moved = found[d] * std::polar(1.0, k * e.row(d).dot(far.centre));
    EXPECT_LT(std::abs(moved - exact[d]), 0.01 * exact.cwiseAbs().maxCoeff()) << d;
  }
}

TEST(FarHarmonics, MonopoleAboveAPlaneSendsItsPower) {
  const Space ground{kAir.fluid, Plane{Eigen::Vector3d(0, 0.6, 0.8), -0.7}};
  const Surface egg = bent_egg(2);
  const Monopole source{{0.1, 0.05, -0.1}};
  const Monopole image{ground.ground->mirrored(source.centre)};
  const double k = 3.0, x = 2.0 * k * ground.ground->height(source.centre);
  const BoundaryEquations equations(egg, ground, frequency_of(k));
  const Eigen::VectorXcd v = source.velocity(k, egg) + image.velocity(k, egg);
  const Eigen::MatrixXcd F = far_harmonics(egg, ground, equations).of_flow * node_flow(egg, v);
  EXPECT_NEAR(0.5 * power_of_far_field(ground) * F.squaredNorm() /
                  (source.power() * (1.0 + std::sin(x) / x)),
              1.0, 0.01);
}

/// Motions of three parts of a body: its faces by thirds of the height, 3 n_f x 3.
Eigen::MatrixXcd parts_of(const Surface& body, const Eigen::VectorXcd& velocity) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(velocity.size(), 3);
  const Eigen::VectorXd z = body.face_centre.col(2);
  const double low = z.minCoeff(), size = z.maxCoeff() - low;
  for (Eigen::Index f = 0; f < body.face_count(); ++f) {
    const auto part = static_cast<Eigen::Index>(std::min(2.0, 3.0 * (z[f] - low) / size));
    out.block(3 * f, part, 3, 1) = velocity.segment(3 * f, 3);
  }
  return out;
}

TEST(FarHarmonics, PowersOfPartsWithTheirExchangeSumToThePowerOfTheWhole) {
  const Surface egg = bent_egg(2);
  const BoundaryEquations equations(egg, kAir, frequency_of(5.0));
  const FarHarmonics far = far_harmonics(egg, kAir, equations);
  const Eigen::VectorXcd v = test::random_matrix<Eigen::MatrixXcd>(3 * egg.face_count(), 1);
  const Eigen::MatrixXd whole = resistance(kAir, far, node_flow(egg, v));
  const Eigen::MatrixXd exchange = resistance(kAir, far, node_flow(egg, parts_of(egg, v)));
  EXPECT_NEAR(exchange.sum() / whole(0, 0), 1.0, 1e-12);
  EXPECT_LT((exchange - exchange.transpose()).norm(), 1e-14 * exchange.norm());
  EXPECT_GT(exchange.diagonal().minCoeff(), 0.0);
}

TEST(FarHarmonics, PowerOfAPartInPhaseIsThatOfThePressuresOnIt) {
  // 1/2 Re int p conj(v_n) dS over the part, p of all parts: without phase differences no reactive
  // power flows from part to part.
  const Surface egg = bent_egg(2);
  for (double k : {2.0, 6.0}) {
    const BoundaryEquations equations(egg, kAir, frequency_of(k));
    const Eigen::MatrixXcd parts = parts_of(egg, at_corners(smooth_motions(egg).rowwise().sum()));
    const Eigen::VectorXd by_far =
        0.5 * resistance(kAir, far_harmonics(egg, kAir, equations), node_flow(egg, parts))
                  .rowwise()
                  .sum();
    const SurfaceState all = equations.radiate(parts.rowwise().sum());
    for (int part = 0; part < 3; ++part) {
      const double on_surface =
          surface_power(egg, {all.frequency_hz, parts.col(part), all.pressure})[0];
      EXPECT_NEAR(by_far[part], on_surface, 0.01 * by_far.sum()) << k << " part " << part;
    }
  }
}

}  // namespace
}  // namespace clatter::sound
