// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold for every body: power, reciprocity, forms of the resistance, invariance.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bodies.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sound/far_field.hpp"
#include "core/sound/field_points.hpp"
#include "tests/random_matrix.hpp"
#include "tests/refusal.hpp"

namespace clatter::sound {
namespace {

using namespace testing;

void expect_monopole(const Surface& surface, const Monopole& source, double k, double tolerance) {
  const SurfaceState state = radiate(surface, kAir, frequency_of(k), source.velocity(k, surface));
  EXPECT_NEAR(surface_power(surface, state)[0] / source.power(), 1.0, tolerance) << k;
  EXPECT_NEAR(far_power(surface, kAir, state)[0] / source.power(), 1.0, tolerance) << k;
  RowMatrix points(3, 3);
  points << 1.5, 0.2, -0.4, 0.0, -2.0, 0.3, 0.7, 0.7, 0.7;
  const Eigen::MatrixXcd p = field_pressure(surface, kAir, state, points);
  for (int n = 0; n < 3; ++n) {  // the mesh also turns the phase a little
    const Complex exact = source.pressure(k, points.row(n));
    EXPECT_LT(std::abs(p(n, 0) - exact), 3.0 * tolerance * std::abs(exact)) << k << " point " << n;
  }
}

TEST(Radiation, MonopoleInsideABentEggSendsItsPower) {
  const Surface egg = bent_egg(2);
  const double limit = kAir.fluid.wavenumber(mesh_limit_hz(egg, kAir.fluid.sound_speed, 5.0));
  for (double k : {0.2, 2.0, limit}) expect_monopole(egg, {{0.1, 0.05, -0.1}}, k, 0.005);
}

TEST(Radiation, MonopoleInsideABoxSendsItsPower) {
  const Surface surface = box({0.8, 0.5, 0.6}, 0.1);
  const double limit = kAir.fluid.wavenumber(mesh_limit_hz(surface, kAir.fluid.sound_speed, 5.0));
  for (double k : {0.5, limit}) expect_monopole(surface, {{0.1, 0.02, -0.05}}, k, 0.005);
}

TEST(Radiation, ResistanceFormsGiveThePowerOfEveryMotion) {
  const Surface egg = bent_egg(2);
  Eigen::MatrixXcd motions(egg.face_count(), 4);
  motions.leftCols(3) = egg.face_normal.cast<Complex>();
  motions.col(3).setOnes();
  const SurfaceState state = radiate(egg, kAir, frequency_of(5.0), at_corners(motions));
  const Eigen::MatrixXd near = surface_resistance(egg, state);
  const Eigen::MatrixXd far = far_resistance(egg, kAir, state);
  EXPECT_EQ(far, far.transpose());
  EXPECT_GT(dense::symmetric_eigen(far, dense::EigenParts::kValues).values.minCoeff(), 0.0);
  EXPECT_LT((near - far).norm(), 0.01 * far.norm());
  const Eigen::MatrixXcd q = test::random_matrix<Eigen::MatrixXcd>(4, 3);
  const SurfaceState combined{state.frequency_hz, state.velocity * q, state.pressure * q};
  const Eigen::VectorXd by_far = far_power(egg, kAir, combined);
  const Eigen::VectorXd by_surface = surface_power(egg, combined);
  for (int m = 0; m < 3; ++m) {
    const auto power = [&](const Eigen::MatrixXd& R) {
      return 0.5 * (q.col(m).adjoint() * R.cast<Complex>() * q.col(m)).value().real();
    };
    // The discarded antisymmetric part breaks reciprocity, an error of the mesh.
    EXPECT_NEAR(power(far) / by_far[m], 1.0, 0.005);
    EXPECT_NEAR(power(near) / by_surface[m], 1.0, 0.005);
    EXPECT_NEAR(by_far[m] / by_surface[m], 1.0, 0.01);
  }
}

/// Pressure at `to` [Pa] of a point source of unit strength A at `from` outside a rigid body.
Complex scattered(const Surface& surface, double k, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  const Monopole source{from, 1.0};
  const SurfaceState state = radiate(surface, kAir, frequency_of(k), -source.velocity(k, surface));
  return source.pressure(k, to) +
         field_pressure(surface, kAir, state, RowMatrix(to.transpose()))(0, 0);
}

TEST(Radiation, TwoMicrophonesAreReciprocal) {
  const Surface egg = bent_egg(2);
  const Eigen::Vector3d left(-0.9, 0.1, 0.3), right(1.1, -0.2, -0.5);
  for (double k : {1.0, 6.0}) {
    const Complex there = scattered(egg, k, left, right), back = scattered(egg, k, right, left);
    EXPECT_LT(std::abs(there - back), 0.005 * std::abs(there)) << k;
    // The body must matter for this to say anything.
    EXPECT_GT(std::abs(there - Monopole{left, 1.0}.pressure(k, right)), 0.02 * std::abs(there));
  }
}

TEST(Radiation, AFaceAndAMicrophoneAreReciprocal) {
  // Of a face with volume velocity v A, and a point source with A = i omega rho Q / (4 pi).
  const Surface egg = bent_egg(2);
  const Eigen::Vector3d microphone(0.9, 0.6, 0.4);
  const double k = 5.0;
  const Monopole source{microphone, 1.0};
  const SurfaceState rigid = radiate(egg, kAir, frequency_of(k), -source.velocity(k, egg));
  for (Eigen::Index face : {7, 120, 300}) {
    Eigen::MatrixXcd v = Eigen::MatrixXcd::Zero(egg.face_count(), 1);
    v(face, 0) = 1.0 / egg.face_area[face];
    const SurfaceState state = radiate(egg, kAir, frequency_of(k), at_corners(v));
    const Complex there = field_pressure(egg, kAir, state, RowMatrix(microphone.transpose()))(0, 0);
    const Complex back =
        (face_pressure(egg, rigid)(face, 0) + source.pressure(k, egg.face_centre.row(face))) *
        Complex(0.0, k * kAir.fluid.impedance() / (4.0 * std::numbers::pi));
    EXPECT_LT(std::abs(there - back), 0.02 * std::abs(back)) << face;
  }
}

TEST(Radiation, MovedTurnedAndScaledBodyRadiatesTheSame) {
  const Surface egg = bent_egg(1);
  const Eigen::AngleAxisd turn(0.8, Eigen::Vector3d(1, 2, -1).normalized());
  RowMatrix nodes = 2.0 * egg.nodes * turn.toRotationMatrix().transpose();
  nodes.rowwise() += Eigen::RowVector3d(5, -3, 2);
  const Surface moved = closed_surface(nodes, egg.triangles);
  const Eigen::MatrixXcd v = test::random_matrix<Eigen::MatrixXcd>(3 * egg.face_count(), 1);
  const auto efficiency = [&](const Surface& surface, double k) {
    const SurfaceState state = radiate(surface, kAir, frequency_of(k), v);
    return radiation_efficiency(surface, kAir.fluid, state, surface_power(surface, state))[0];
  };
  // Rounding may change which rule a pair of facets takes.
  EXPECT_NEAR(efficiency(egg, 4.0) / efficiency(moved, 2.0), 1.0, 1e-6);
}

/// A flat cylinder about z with sides of area pi: rings of a disc above and below.
Surface disc(double thickness, int rings) {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<std::array<int, 3>> faces;
  const auto ring_begin = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  const int side = ring_begin(rings + 1);
  const double corner = std::numbers::pi / (3.0 * rings);  // angle of a polygon's edge
  const double radius = std::sqrt(corner / std::sin(corner));
  for (double z : {0.5 * thickness, -0.5 * thickness})
    for (int ring = 0; ring <= rings; ++ring)
      for (int j = 0; j < std::max(1, 6 * ring); ++j) {
        const double angle = 2.0 * std::numbers::pi * j / std::max(1, 6 * ring);
        const double r = radius * ring / rings;
        nodes.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
  const auto add = [&](int a, int b, int c) {
    faces.push_back({a, b, c});
    faces.push_back({a + side, c + side, b + side});
  };
  for (int ring = 1; ring <= rings; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int j = 0; j < ring; ++j) {
        const int outer = 6 * ring, inner = std::max(1, 6 * (ring - 1));
        const int a = ring_begin(ring) + sector * ring + j;
        const int b = ring_begin(ring) + (sector * ring + j + 1) % outer;
        const int c = ring_begin(ring - 1) + (sector * (ring - 1) + j) % inner;
        add(a, b, c);
        if (j + 1 < ring) add(c, b, ring_begin(ring - 1) + (sector * (ring - 1) + j + 1) % inner);
      }
  const int rim = ring_begin(rings), count = 6 * rings;
  for (int j = 0; j < count; ++j) {
    const int a = rim + j, b = rim + (j + 1) % count;
    faces.push_back({a, a + side, b});
    faces.push_back({b, a + side, b + side});
  }
  Triangles out{RowMatrix(nodes.size(), 3), IndexMatrix(faces.size(), 3)};
  for (size_t n = 0; n < nodes.size(); ++n)
    out.nodes.row(static_cast<Eigen::Index>(n)) = nodes[n].transpose();
  for (size_t f = 0; f < faces.size(); ++f)
    for (size_t a = 0; a < 3; ++a)
      out.faces(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(a)) = faces[f][a];
  return closed_surface(out.nodes, out.faces);
}

/// Efficiency of a breathing disc, and its pressure 1.5 m above the middle of its upper side.
Eigen::Vector2d breathing_disc(double thickness, double ka) {
  const Surface plate = disc(thickness, 5);
  const SurfaceState state =
      radiate(plate, kAir, frequency_of(ka),
              at_corners(plate.face_normal.col(2).cwiseAbs().cast<Complex>()));
  const Eigen::VectorXd sigma =
      radiation_efficiency(plate, kAir.fluid, state, far_power(plate, kAir, state));
  const RowMatrix above = Eigen::RowVector3d(0, 0, 1.5 + 0.5 * thickness);
  return {sigma[0], std::abs(field_pressure(plate, kAir, state, above)(0, 0))};
}

TEST(Radiation, PistonInAnInfiniteBaffleIsTheHalfOfAThinBreathingDisc) {
  // Both sides of a thin disc move outward: by symmetry nothing flows through the plane between
  // them, which is the baffle. Its thickness has an effect of first order, which is extrapolated.
  const double ka = 2.0;
  const Eigen::Vector2d thin = 2.0 * breathing_disc(0.06, ka) - breathing_disc(0.12, ka);
  // Rayleigh 1896, section 302.
  EXPECT_NEAR(thin[0] / (1.0 - std::cyl_bessel_j(1.0, 2.0 * ka) / ka), 1.0, 0.01);
  const double on_axis = 2.0 * kAir.fluid.impedance() *
                         std::abs(std::sin(0.5 * ka * (std::sqrt(1.5 * 1.5 + 1.0) - 1.5)));
  EXPECT_NEAR(thin[1] / on_axis, 1.0, 0.01);
}

TEST(Radiation, BadInputIsRefused) {
  const Surface egg = bent_egg(0);
  const Eigen::MatrixXcd v = Eigen::MatrixXcd::Ones(3 * egg.face_count(), 1);
  const auto refusal = [&](double frequency, const Eigen::MatrixXcd& velocity) {
    return test::refusal_of([&] { radiate(egg, kAir, frequency, velocity); });
  };
  test::expect_parts(refusal(0.0, v), {"radiation: found a frequency of 0 Hz"});
  test::expect_parts(refusal(100.0, v.topRows(3)),
                     {"found 3 normal velocities", "one a corner of each face, 60"});
  Eigen::MatrixXcd wrong = v;
  wrong(4, 0) = std::numeric_limits<double>::infinity();
  test::expect_parts(refusal(100.0, wrong), {"a normal velocity that is not finite"});
  const SurfaceState state = radiate(egg, kAir, 100.0, v);
  test::expect_parts(
      test::refusal_of([&] { field_pressure(egg, kAir, state, RowMatrix(RowMatrix::Zero(1, 3))); }),
      {"field point 0: found (0, 0, 0) m inside the body, expected a point outside"});
  test::expect_parts(test::refusal_of([&] {
                       require_in_fluid(egg, kAir, "microphone 'near'", 1.001 * egg.nodes.row(0));
                     }),
                     {"microphone 'near': found", "m from the body, expected a point", "m away"});
}

}  // namespace
}  // namespace clatter::sound
