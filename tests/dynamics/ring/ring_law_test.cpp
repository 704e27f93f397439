// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a ring over its duty parameter.
#include "dynamics/ring/ring_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clatter::dynamics {
namespace {

constexpr double kSpeed = 5.0, kViscosity = 0.01, kLoad = 2000.0, kRadius = 0.02;

RingSpec some_ring() {
  RingSpec ring;
  ring.face_radius = kRadius;
  ring.load = kLoad;
  ring.boundary = 0.12;
  return ring;
}

/// Load and shear of the parabola h = h_0 + x^2 / (2 R) that slides, flooded, up to its rupture
/// where p = p' = 0, by sums over x.
struct Parabola {
  double load = 0.0, shear = 0.0;
};
Parabola by_quadrature(double film) {
  const double length = std::sqrt(2.0 * kRadius * film);
  const auto sums = [&](double rupture, double* pressure, Parabola* found) {
    const int steps = 200000;
    const double first = -1.57079;  // of the angle g, x = length tan g
    const double dg = (rupture - first) / steps;
    const double h_c = film / std::pow(std::cos(rupture), 2);
    double p = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double g = first + (k + 0.5) * dg, c = std::cos(g), h = film / (c * c);
      const double dx = length / (c * c) * dg;
      const double slope = 6.0 * kViscosity * kSpeed * (h - h_c) / (h * h * h);
      if (found != nullptr) {
        found->load += (p + 0.5 * slope * dx) * dx;
        found->shear += (kViscosity * kSpeed / h + 0.5 * h * slope) * dx;
      }
      p += slope * dx;
    }
    *pressure = p;
  };
  double low = 0.2, high = 0.8, pressure = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    sums(middle, &pressure, nullptr);
    (pressure > 0.0 ? low : high) = middle;
  }
  Parabola found;
  sums(low, &pressure, &found);
  return found;
}

TEST(RingFriction, OfTheFullFilmIsTheShearOfMartinsParabola) {
  for (const double film : {2e-6, 5e-6}) {
    const Parabola exact = by_quadrature(film);
    const double duty = kViscosity * kSpeed / exact.load;
    EXPECT_NEAR(2.4474842 * duty * kRadius, film, 1e-5 * film);
    RingSpec ring = some_ring();
    ring.roughness = 0.01e-6;  // lambda of 200 and more
    EXPECT_NEAR(ring_friction(ring, duty).value, exact.shear / exact.load,
                1e-4 * exact.shear / exact.load);
  }
}

TEST(RingFriction, GoesFromTheBoundaryToTheFilmByTheAsperities) {
  const RingSpec ring = some_ring();
  EXPECT_DOUBLE_EQ(ring_friction(ring, 0.0).value, 0.12);
  const double apart = 4.0 * ring.roughness / (2.4474842 * kRadius);  // lambda 4
  EXPECT_NEAR(ring_friction(ring, apart).value, 3.2914322 * std::sqrt(apart), 1e-12);
  EXPECT_NEAR(ring_friction(ring, 2.0 * apart).value, 3.2914322 * std::sqrt(2.0 * apart), 1e-12);
  const double share = std::pow(0.5, 6.804);  // lambda 2
  EXPECT_NEAR(ring_friction(ring, 0.5 * apart).value,
              share * 0.12 + (1.0 - share) * 3.2914322 * std::sqrt(0.5 * apart), 1e-12);
}

TEST(RingFriction, SlopesAreThoseOfItsValues) {
  const RingSpec ring = some_ring();
  for (double duty = 1e-7; duty < 1e-3; duty *= 1.7) {
    const double h = 1e-5 * duty;
    const double slope =
        (ring_friction(ring, duty + h).value - ring_friction(ring, duty - h).value) / (2.0 * h);
    EXPECT_NEAR(ring_friction(ring, duty).slope, slope,
                1e-5 * std::abs(slope) + 1e-6 / duty * 1e-5);
  }
  for (double speed = -12.0; speed < 12.0; speed += 0.37) {
    const double h = 1e-6;
    const auto force = [&](double u) { return ring_shear(ring, kViscosity, kLoad, u, 1e-2).force; };
    const double slope = (force(speed + h) - force(speed - h)) / (2.0 * h);
    EXPECT_NEAR(ring_shear(ring, kViscosity, kLoad, speed, 1e-2).slope, slope,
                1e-5 * std::abs(slope) + 1e-3);
    EXPECT_EQ(force(-speed), -force(speed));
    EXPECT_LE(force(speed) * speed, 0.0);
  }
}

}  // namespace
}  // namespace clatter::dynamics
