// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case N21: the sound of bodies that are small beside the wavelength, and of thin ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synthetic.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;

/// The part of an ellipsoid's own volume that it takes along as air: Lamb 1932, section 114, by the
/// midpoint rule over l = s^2 t^2 / (1 - t)^2.
double added_mass(const Eigen::Vector3d& axes, int direction) {
  constexpr int kSteps = 20000;
  const double s = axes.maxCoeff();
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps, rest = 1.0 - t;
    const Eigen::Array3d long_axes = axes.array().square() + std::pow(s * t / rest, 2);
    sum += axes.prod() * s * s * 2.0 * t / std::pow(rest, 3) / kSteps /
           (long_axes[direction] * std::sqrt(long_axes.prod()));
  }
  return sum / (2.0 - sum);
}

/// Power per (1/2 v^2) of an ellipsoid that is small beside the wavelength and moves along an axis:
/// that of a dipole of the force on the air inside and around it [W s2/m2].
double dipole_power(const sound::Fluid& air, const Eigen::Vector3d& axes, int direction,
                    double frequency_hz) {
  const double omega = 2.0 * kPi * frequency_hz, density = air.impedance() / air.sound_speed;
  const double volume = 4.0 / 3.0 * kPi * axes.prod();
  const double force = omega * density * volume * (1.0 + added_mass(axes, direction));
  return 2.0 * std::pow(omega * force, 2) / (24.0 * kPi * density * std::pow(air.sound_speed, 3));
}

Mesh6 ellipsoid(const Eigen::Vector3d& axes) {
  Mesh6 mesh = unit_sphere(3);
  mesh.nodes = mesh.nodes * axes.asDiagonal();
  return mesh;
}

TEST(HardN21_SmallBodies, ShakenSpheresRadiateFromTheLowestFrequencyToTheHighest) {
  double worst = 0.0;
  for (const auto& [radius, to_hz] :
       {std::pair(0.1, 200.0), std::pair(0.1, 1000.0), std::pair(0.03, 500.0)}) {
    const PartSound sound =
        sound_of_rigid(bare_skin(ellipsoid(Eigen::Vector3d::Constant(radius))), to_hz);
    for (const SoundSample& sample : sound.table.samples) {
      const double q = std::pow(sound.table.fluid.wavenumber(sample.frequency_hz) * radius, 4);
      const double exact =
          sound.table.fluid.impedance() * 4.0 * kPi * radius * radius / 3.0 * q / (4.0 + q);
      for (int d = 0; d < 3; ++d)
        worst = std::max(worst, std::abs(10.0 * std::log10(sample.R(d, d) / exact)));
    }
  }
  test::expect_at_most("error of the power of shaken spheres [dB]", worst, 0.1);
}

TEST(HardN21_SmallBodies, FlatAndSlenderBodiesTakeTheirAirAlong) {
  double worst = 0.0;
  for (const Eigen::Vector3d& axes :
       {Eigen::Vector3d(0.1, 0.1, 0.005), Eigen::Vector3d(0.1, 0.02, 0.02),
        Eigen::Vector3d(0.12, 0.08, 0.04)}) {
    const PartSound sound = sound_of_rigid(bare_skin(ellipsoid(axes)), 300.0);
    const SoundSample& lowest = sound.table.samples.front();
    for (int d = 0; d < 3; ++d)
      worst = std::max(worst, std::abs(10.0 * std::log10(lowest.R(d, d) /
                                                         dipole_power(sound.table.fluid, axes, d,
                                                                      lowest.frequency_hz))));
  }
  test::expect_at_most("error of the power of ellipsoids [dB]", worst, 0.6);
}

TEST(HardN21_SmallBodies, AThinBodyHasNoPointSourceInside) {
  const PartSound sound = sound_of_rigid(bare_skin(box({0.2, 0.2, 0.004}, 6)), 300.0);
  EXPECT_FALSE(sound.certificate.monopole_error_db.has_value());
  EXPECT_LT(sound.certificate.shape_error, 0.01);
}

TEST(HardN21_SmallBodies, AShapeThatTakesTooManyFacesIsRefused) {
  SoundOptions options;
  options.skin.mesh.most_faces = 100;
  StepClock clock;
  test::expect_parts(
      test::refusal_of<NumericsError>([&] {
        const Mesh6 mesh = ellipsoid({0.1, 0.1, 0.1});
        part_sound(model_on(mesh, random_rows(mesh, 3, 1), 5000.0), options, clock);
      }),
      {"acoustic skin: ", "expected at most 100 (skin.most_faces)", "raise skin.shape_error"});
}

}  // namespace
}  // namespace clatter::recover
