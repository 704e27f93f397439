// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid ground plane by images.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies.hpp"
#include "core/sound/far_field.hpp"
#include "core/sound/field_points.hpp"
#include "core/sound/monopole.hpp"
#include "tests/refusal.hpp"

namespace clatter::sound {
namespace {

using namespace testing;

const Space kGround{kAir.fluid, Plane{Eigen::Vector3d(0, 0.6, 0.8), -0.7}};

TEST(Ground, MonopoleAboveAPlaneSendsThePowerOfSourceAndImage) {
  const Surface egg = bent_egg(2);
  const Monopole source{{0.1, 0.05, -0.1}};
  const Monopole image{kGround.ground->mirrored(source.centre)};
  const double height = kGround.ground->height(source.centre);
  for (double k : {0.5, 3.0, 8.0}) {
    const SurfaceState state =
        radiate(egg, kGround, frequency_of(k), source.velocity(k, egg) + image.velocity(k, egg));
    const double x = 2.0 * k * height;
    const double exact = source.power() * (1.0 + std::sin(x) / x);
    EXPECT_NEAR(surface_power(egg, state)[0] / exact, 1.0, 0.005) << k;
    EXPECT_NEAR(far_power(egg, kGround, state)[0] / exact, 1.0, 0.005) << k;
    const Eigen::Vector3d point(1.0, 0.3, 0.2);
    const Complex p = source.pressure(k, point) + image.pressure(k, point);
    EXPECT_LT(std::abs(field_pressure(egg, kGround, state, RowMatrix(point.transpose()))(0, 0) - p),
              0.015 * std::abs(p));
  }
}

TEST(Ground, CheckOfABodyByAMonopoleFindsItsPower) {
  const Surface surface = box({0.5, 0.3, 0.4}, 0.1);
  const Eigen::Vector3d inside = inner_point(surface, 0.1).value();
  EXPECT_FALSE(inner_point(surface, 0.16).has_value());
  EXPECT_NEAR(distance_to(surface, inside), 0.15, 1e-9);
  for (const Space& space : {kAir, kGround}) {
    const MonopoleMotion check = monopole(surface, space, frequency_of(7.0), inside);
    const SurfaceState state = radiate(surface, space, frequency_of(7.0), check.velocity);
    EXPECT_NEAR(far_power(surface, space, state)[0] / check.power, 1.0, 0.01);
  }
}

TEST(Ground, BodyWithItsImageAsSecondBodyRadiatesTwiceThePower) {
  const Surface egg = bent_egg(1);
  RowMatrix nodes(2 * egg.node_count(), 3);
  IndexMatrix faces(2 * egg.face_count(), 3);
  for (Eigen::Index n = 0; n < egg.node_count(); ++n) {
    nodes.row(n) = egg.nodes.row(n);
    nodes.row(egg.node_count() + n) = kGround.ground->mirrored(egg.nodes.row(n)).transpose();
  }
  faces.topRows(egg.face_count()) = egg.triangles;
  faces.bottomRows(egg.face_count()) =
      egg.triangles.array() + static_cast<int32_t>(egg.node_count());
  faces.bottomRows(egg.face_count()).col(1).swap(faces.bottomRows(egg.face_count()).col(2));
  const Surface pair = closed_surface(nodes, faces);
  const Eigen::MatrixXcd one = egg.face_normal.col(0).cast<Complex>();
  Eigen::MatrixXcd two(pair.face_count(), 1);
  two << one, one;
  const double f = frequency_of(3.0);
  const double above = surface_power(egg, radiate(egg, kGround, f, at_corners(one)))[0];
  // The rule of a common edge is not symmetric, and images exchange the corners.
  EXPECT_NEAR(surface_power(pair, radiate(pair, kAir, f, at_corners(two)))[0] / above, 2.0, 1e-5);
}

TEST(Ground, BodyOrMicrophoneBelowThePlaneIsRefused) {
  const Surface egg = bent_egg(0);
  const Eigen::MatrixXcd v = Eigen::MatrixXcd::Ones(3 * egg.face_count(), 1);
  const Space cutting{kAir.fluid, Plane{Eigen::Vector3d::UnitZ(), 0.0}};
  test::expect_parts(test::refusal_of([&] { radiate(egg, cutting, 100.0, v); }),
                     {"ground plane: found node", "m above it, expected more than 0"});
  test::expect_parts(
      test::refusal_of([&] {
        require_in_fluid(egg, kGround, "microphone 'm1'", {0, 0, -2});
      }),
      {"microphone 'm1': found (0, 0, -2) m below the ground plane, expected a point above it"});
}

}  // namespace
}  // namespace clatter::sound
