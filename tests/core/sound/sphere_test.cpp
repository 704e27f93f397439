// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres with exact solutions: order of convergence, and irregular frequencies.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies.hpp"
#include "core/sound/boundary_matrices.hpp"
#include "core/sound/complex_lu.hpp"
#include "core/sound/far_field.hpp"

namespace clatter::sound {
namespace {

using namespace testing;

/// Pulsating, oscillating along z, and a quadrupole x y; radius 1 m, so k = ka.
Eigen::MatrixXcd motions(const Surface& sphere) {
  Eigen::MatrixXcd v(sphere.face_count(), 3);
  v.col(0).setOnes();
  v.col(1) = sphere.face_normal.col(2).cast<Complex>();
  v.col(2) = sphere.face_normal.col(0).cwiseProduct(sphere.face_normal.col(1)).cast<Complex>();
  return at_corners(v);
}

/// Radiation efficiencies of the three: 1 / ((ka)^2 |h_m'(ka)|^2).
Eigen::Vector3d exact_efficiency(double ka) {
  const double q = ka * ka;
  return {q / (1 + q), q * q / (4 + q * q), q * q * q / (81 + 9 * q - 2 * q * q + q * q * q)};
}

struct Errors {
  Eigen::Vector3d surface, far;  // relative errors of the efficiencies
  double pressure;               // of the pulsating sphere, relative, RMS over the nodes
  double condition;
};

Errors sphere_errors(int levels, double ka) {
  const Surface sphere = unit_sphere(levels);
  const SurfaceState state = radiate(sphere, kAir, frequency_of(ka), motions(sphere));
  const auto error = [&](const Eigen::VectorXd& power) -> Eigen::Vector3d {
    return (radiation_efficiency(sphere, kAir.fluid, state, power)
                .cwiseQuotient(exact_efficiency(ka))
                .array() -
            1.0)
        .abs();
  };
  const Complex p = kAir.fluid.impedance() * Complex(0, ka) / Complex(1, ka);
  const double rms = (state.pressure.col(0).array() - p).matrix().norm() /
                     std::sqrt(static_cast<double>(sphere.node_count()));
  return {error(surface_power(sphere, state)), error(far_power(sphere, kAir, state)),
          rms / std::abs(p), state.condition};
}

TEST(Order, SpheresConvergeWithSecondOrder) {
  const Errors coarse = sphere_errors(1, 2.0), medium = sphere_errors(2, 2.0),
               fine = sphere_errors(3, 2.0);  // 80, 320, 1280 faces
  for (int m = 0; m < 3; ++m) {
    // Second order divides by four; the coarse mesh has 2.3 edges a radius.
    EXPECT_GT(coarse.surface[m] / medium.surface[m], 3.6) << m;
    EXPECT_GT(medium.surface[m] / fine.surface[m], 3.8) << m;
    EXPECT_GT(coarse.far[m] / fine.far[m], 13.0) << m;
  }
  EXPECT_GT(medium.pressure / fine.pressure, 3.6);
  EXPECT_LT(fine.surface.maxCoeff(), 0.007);
}

TEST(Order, EfficiencyOfPulsatingAndOscillatingSphereIsWithinOnePercentOn320Faces) {
  for (double ka : {0.5, 1.0, 4.0, 6.0}) {
    const Errors error = sphere_errors(2, ka);
    EXPECT_LT(error.surface.head(2).maxCoeff(), 0.01) << ka;
    EXPECT_LT(error.far.head(2).maxCoeff(), 0.01) << ka;
  }
}

TEST(Order, FarFieldPowerHoldsWhereHardlyAnythingIsRadiated) {
  // At ka = 0.05 the quadrupole has an efficiency of 2e-10.
  const Errors error = sphere_errors(2, 0.05);
  EXPECT_LT(error.far.head(2).maxCoeff(), 0.01);
  EXPECT_LT(error.far[2], 0.03);
}

TEST(Order, IrregularFrequenciesOfTheSphereLeaveNoTrace) {
  // Zeros of j_0, j_1, j_2 and j_0: the interior of the sphere resonates with zero pressure on it.
  for (double ka : {3.141593, 4.493409, 5.763459, 6.283185}) {
    const Errors error = sphere_errors(2, ka);
    EXPECT_LT(error.surface.head(2).maxCoeff(), 0.01) << ka;
    EXPECT_LT(error.pressure, 0.01) << ka;
    EXPECT_LT(error.condition, 50.0) << ka;
  }
}

TEST(Order, WithoutCouplingTheFirstIrregularFrequencyIsThere) {
  const Surface sphere = unit_sphere(1);
  const auto highest_condition = [&](bool coupled) {
    double highest = 0.0;
    for (double ka = 3.0; ka < 3.3; ka += 0.02) {
      const Complex alpha = coupled ? burton_miller_coupling(sphere, ka) : 0.0;
      BoundaryMatrices matrices = boundary_matrices(sphere, kAir, ka, alpha);
      highest = std::max(highest, ComplexLu(std::move(matrices.A_transposed)).condition());
    }
    return highest;
  };
  EXPECT_GT(highest_condition(false), 500.0);
  EXPECT_LT(highest_condition(true), 20.0);
}

}  // namespace
}  // namespace clatter::sound
