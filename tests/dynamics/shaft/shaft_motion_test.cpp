// SPDX-License-Identifier: GPL-3.0-or-later
// Shafts in motion: journals settle, discs whirl, energy is kept, phasers rattle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/dense/complex.hpp"
#include "dynamics/run/energy.hpp"
#include "dynamics/shaft/disc_gyroscope.hpp"
#include "dynamics/shaft/shaft_beam.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/shaft_model.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::VectorXd;
using testing::ShaftModelOf;
using testing::started;
using testing::steel_shaft;

/// A short shaft in one bearing of 24 x 16 mm in its middle, with a large flywheel.
std::string journal(const char* model, double rpm) {
  return fmt::format(R"(
[[shaft]]
name = "cam"
speed_rpm = {}
[[shaft.section]]
from_mm = -8
to_mm = 8
diameter_mm = 24
[[shaft.bearing]]
name = "b"
at_mm = 0
model = "{}"
diameter_mm = 24
width_mm = 16
clearance = 2e-3
viscosity_mpa_s = 10
[[shaft.disc]]
name = "flywheel"
at_mm = 0
mass_kg = 0.2
polar_kg_m2 = 1e3
diametral_kg_m2 = 1
)",
                     rpm, model);
}

struct Settled {
  double e = 0.0, angle = 0.0;  // relative; from the load to the eccentricity, with the rotation
};

Settled settled(const char* model, double rpm, double load) {
  ShaftModelOf shaft(journal(model, rpm));
  System& system = shaft.system();
  const int x = shaft.y("cam.flywheel", 0), y = shaft.y("cam.flywheel", 1);
  VectorXd direction = VectorXd::Zero(6);
  direction(1) = -1.0 / std::sqrt(system.bodies()[0].mass);
  system.add_load({"load", 0, direction, [load](double) { return load; }});
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-4, 1e-5, 0.1, 0.05};
  const auto run = started(system, options);
  while (run->state().time < 0.5) run->step(0.5);
  const Eigen::Vector2d at(run->state().y(x), run->state().y(y));
  const double turned = std::atan2(at.y(), at.x()) + 0.5 * std::numbers::pi;
  return {at.norm() / 24e-6, rpm > 0.0 ? turned : -turned};
}

TEST(ShaftMotion, OracleOfALoadedJournalAt1700Rpm) {
  const ButenschoenMap map(16.0 / 24.0);
  for (const auto& [load, e] : {std::pair{100.0, 0.551326}, std::pair{1000.0, 0.890935}}) {
    const Settled found = settled("butenschoen", 1700.0, load);
    std::printf("%.0f N: e %.6f, reference %.6f, attitude %.3f deg\n", load, found.e, e,
                found.angle * 180.0 / std::numbers::pi);
    EXPECT_NEAR(found.e, e, 2e-6);                       // the reference's digits
    EXPECT_NEAR(found.angle, map.angle(found.e), 1e-5);  // the smoothing over 0.1 rad/s
    const Settled back = settled("butenschoen", -1700.0, load);
    EXPECT_NEAR(back.e, found.e, 1e-6);
    EXPECT_NEAR(back.angle, found.angle, 1e-5);
  }
}

TEST(ShaftMotion, ByMoesTheJournalSettlesNearby) {
  // Both fits differ by 9 % in So at e = 0.5, 20 % at 0.8.
  EXPECT_NEAR(settled("moes", 1700.0, 100.0).e, 0.5513, 0.04);
  EXPECT_NEAR(settled("moes", 1700.0, 1000.0).e, 0.8909, 0.03);
}

/// A disc at the end of a massless shaft; at the other end is one of `clamp` times its inertia,
/// which with 1e9 makes a cantilever.
struct Overhung {
  static constexpr double kMass = 2.0, kPolar = 0.02, kDiametral = 0.011, kLength = 0.25;
  System system;
  ShaftSections steel{{{0.0, kLength, 0.02, 0.0}}, {}};
  std::vector<int> y;  // of the disc

  Overhung(double spin, double loss_time, double clamped = 1e9, double start = 0.0) {
    const ShaftAxes axes;
    const ShaftFlexibility piece = steel.flexibility(0.0, kLength);
    ModalBody disc = make_disc_body("disc", {kMass, kPolar, kDiametral}, axes, {0.0, spin});
    disc.eta_start(0) = start * std::sqrt(kMass);
    disc.v_start(4) = 3.0 * start / kLength * spin * std::sqrt(kDiametral);
    const int clamp = system.add_body(make_disc_body(
        "clamp", {clamped * kMass, clamped * kPolar, clamped * kDiametral}, axes, {0.0, spin}));
    const int body = system.add_body(disc);
    std::vector<int> both;
    for (int k = 0; k < 6; ++k) both.push_back(system.coordinate(clamp, k));
    for (int k = 0; k < 6; ++k) y.push_back(system.coordinate(body, k));
    both.insert(both.end(), y.begin(), y.end());
    system.add_element(std::make_unique<ShaftBeam>("beam", both, axes, BeamEnds{kLength, 0.0, 0.0},
                                                   piece, loss_time));
    system.add_element(
        std::make_unique<DiscGyroscope>("gyroscope", std::vector<int>{y[3], y[4], y[5]}, kPolar));
  }
  testing::LinearMotion linear(double spin) {
    VectorXd at = VectorXd::Zero(12), v = VectorXd::Zero(12);
    v(5) = v(11) = spin;
    return testing::linearised(system, at, v);
  }
};

/// Imaginary parts of the eigenvalues above `least`, ascending [rad/s].
std::vector<double> whirl_speeds(const Eigen::VectorXcd& values, double least) {
  std::vector<double> found;
  for (const std::complex<double>& value : values)
    if (value.imag() > least) found.push_back(value.imag());
  std::sort(found.begin(), found.end());
  return found;
}

TEST(ShaftMotion, AnOverhungDiscWhirlsForwardAndBackwardAsInClosedForm) {
  for (const double spin : {0.0, 300.0, 2000.0}) {
    Overhung rotor(spin, 0.0);
    // With z = x + i y, s = slope: (k - w^2 diag(m, I_d) + w W diag(0, I_p)) (z, s) = 0; w > 0
    // forward.
    const Eigen::Matrix2d k = rotor.steel.flexibility(0.0, Overhung::kLength).bending.inverse();
    const double m = Overhung::kMass, d = Overhung::kDiametral, p = Overhung::kPolar * spin;
    // (k11 - m w^2)(k22 - d w^2 + p w) - k12^2 as a polynomial in w; its companion matrix.
    const double c[5] = {k(0, 0) * k(1, 1) - k(0, 1) * k(1, 0), p * k(0, 0),
                         -d * k(0, 0) - m * k(1, 1), -m * p, m * d};
    Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
    for (int i = 0; i < 4; ++i) companion(i, 3) = -c[i] / c[4];
    for (int i = 0; i < 3; ++i) companion(i + 1, i) = 1.0;
    std::vector<double> exact;
    for (const std::complex<double>& root : dense::eigenvalues(companion))
      exact.push_back(std::abs(root.real()));
    std::sort(exact.begin(), exact.end());
    // Torsion and stretch are left out of the closed form.
    std::vector<double> found = whirl_speeds(testing::eigenvalues(rotor.linear(spin)), 1.0);
    for (const double speed : exact) {
      const auto nearest = std::min_element(found.begin(), found.end(), [&](double a, double b) {
        return std::abs(a - speed) < std::abs(b - speed);
      });
      std::printf("spin %6.0f: whirl %.6f rad/s, closed form %.6f\n", spin, *nearest, speed);
      EXPECT_NEAR(*nearest, speed, 2e-7 * speed);  // the clamp gives by 1e-9
      found.erase(nearest);
    }
  }
}

TEST(ShaftMotion, DampingThatTurnsWithTheShaftDrivesForwardWhirlAboveItsCriticalSpeed) {
  // Decay of the slow forward whirl is -T k/(2 m) (1 - W/w), of the backward one with 1 + W/w: of
  // either sign at the same loss time (Genta 2005).
  const double loss = 1e-6;
  const auto slowest = [&](double spin) {
    Overhung rotor(spin, loss);
    double worst = -1e9;
    for (const std::complex<double>& value : testing::eigenvalues(rotor.linear(spin)))
      if (std::abs(value.imag()) > 50.0 && std::abs(value.imag()) < 600.0)
        worst = std::max(worst, value.real());
    return worst;
  };
  Overhung still(0.0, 0.0);
  const double w = whirl_speeds(testing::eigenvalues(still.linear(0.0)), 10.0).front();
  EXPECT_NEAR(slowest(0.0), -0.5 * loss * w * w, 0.01 * loss * w * w);
  EXPECT_LT(slowest(0.7 * w), 0.0);
  EXPECT_GT(slowest(2.0 * w), 0.0);
}

TEST(ShaftMotion, AnUndampedRotorKeepsItsEnergyAndADampedOneLosesWhatItSays) {
  for (const double loss : {0.0, 1e-5}) {
    double before = 1.0;
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
      Overhung rotor(400.0, loss, 3.0, 1e-4);
      EnergyBalance energy(rotor.system);
      StepOptions options;
      options.largest = 1e-3;
      options.accuracy = {tolerance, 1e-4, 0.1, 0.05};
      const auto run = make_integrator(rotor.system, options);
      run->set_observer(&energy);
      run->start(-1e-7, rotor.system.eta_start(), rotor.system.v_start());
      const double bent = energy.now().element;
      while (run->state().time < 0.05) run->step(0.05);
      // What vibrates at the start has the energy of the bent shaft.
      const double error = std::abs(energy.imbalance()) / bent;
      std::printf("loss time %.0e, tolerance %.0e: %.1e of %.3e J lost, error %.1e, %lld steps\n",
                  loss, tolerance, energy.now().lost, bent, error, run->statistics().accepted);
      EXPECT_LT(error, 0.6 * before);
      before = error;
      EXPECT_EQ(energy.now().lost > 0.1 * bent, loss > 0.0);
    }
    EXPECT_LT(before, 2e-3);
  }
}

TEST(ShaftMotion, ARotorConvergesWithTheSquareOfTheSteps) {
  const auto displaced = [](double step) {
    Overhung rotor(400.0, 1e-6, 3.0, 1e-4);
    StepOptions options;
    options.fixed = true;
    options.largest = step;
    const auto run = make_integrator(rotor.system, options);
    run->start(0.0, rotor.system.eta_start(), rotor.system.v_start());
    while (run->state().time < 0.0128 * (1.0 - 1e-9)) run->step(0.0128);
    return Eigen::Vector4d(run->state().y(rotor.y[0]), run->state().y(rotor.y[1]),
                           0.25 * run->state().y(rotor.y[3]), 0.25 * run->state().y(rotor.y[4]));
  };
  const Eigen::Vector4d fine = displaced(1e-6);
  double before = 0.0;
  for (const double step : {6.4e-5, 3.2e-5, 1.6e-5}) {
    const double error = (displaced(step) - fine).norm();
    std::printf("step %.1e s: error %.2e m\n", step, error);
    if (before != 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.6) << step;
    }
    before = error;
  }
}

/// A wheel that turns on a hub within a backlash.
std::string phaser(const char* model, double damping) {
  return fmt::format(R"(
[[shaft]]
name = "cam"
model = "{}"
[[shaft.section]]
from_mm = 0
to_mm = 100
diameter_mm = 24
[[shaft.disc]]
name = "wheel"
at_mm = 20
mass_kg = 0.6
polar_kg_m2 = 1.15e-3
[shaft.disc.phaser]
stiffness_n_m_rad = 2e4
damping_n_m_s_rad = {}
backlash_deg = 2
)",
                     model, damping);
}

TEST(ShaftMotion, APhaserRattlesBetweenItsStops) {
  for (const char* model : {"full", "torsion"}) {
    ShaftModelOf shaft(phaser(model, 0.0));
    System& system = shaft.system();
    const int hub_dof = std::string(model) == "full" ? 5 : 0;
    const int wheel = shaft.y("cam.wheel", 0), hub = shaft.y("cam.wheel_hub", hub_dof);
    const double I1 = 1.15e-3,
                 I2 = 1.0 / testing::inverse_mass(system, hub);  // of the slice of shaft
    VectorXd v = VectorXd::Zero(system.modes());
    const double speed = 2.0;  // of the wheel [rad/s]
    v(system.mode_offset(shaft.builder.body("cam.wheel"))) = speed * std::sqrt(I1);
    // Free over 2 deg, then half a period against the stop, and back.
    const double w = std::sqrt(2e4 * (1.0 / I1 + 1.0 / I2));
    const double gap = 2.0 * std::numbers::pi / 180.0,
                 period = 2.0 * (gap / speed + std::numbers::pi / w);
    StepOptions options;
    options.largest = 1e-4;
    options.accuracy = {1e-5, 1e-6, 0.1, 0.05};
    const auto run = make_integrator(system, options);
    run->start(-options.first, VectorXd::Zero(system.modes()), v);
    double farthest = 0.0;
    const double end = 3.0 * period;
    while (run->state().time < end) {
      run->step(end);
      const double twist = run->state().y(wheel) - run->state().y(hub);
      farthest = std::max(farthest, std::abs(twist));
    }
    const double twist = run->state().y(wheel) - run->state().y(hub),
                 rate = run->state().v_y(wheel) - run->state().v_y(hub);
    // Back in the middle, as at the start.
    EXPECT_NEAR(twist, 0.0, 2e-3 * gap) << model;
    EXPECT_NEAR(rate, speed, 1e-3 * speed) << model;
    EXPECT_NEAR(farthest, 0.5 * gap + speed / w, 1e-2 * gap) << model;
  }
}

TEST(ShaftMotion, TheOilOfAPhaserStopsItsRattle) {
  ShaftModelOf shaft(phaser("torsion", 0.5));
  System& system = shaft.system();
  const int wheel = shaft.y("cam.wheel", 0), hub = shaft.y("cam.wheel_hub", 0);
  VectorXd v = VectorXd::Zero(system.modes());
  v(system.mode_offset(shaft.builder.body("cam.wheel"))) = 2.0 * std::sqrt(1.15e-3);
  StepOptions options;
  options.largest = 1e-3;
  const auto run = make_integrator(system, options);
  run->start(-options.first, VectorXd::Zero(system.modes()), v);
  while (run->state().time < 0.05) run->step(0.05);
  EXPECT_NEAR(run->state().v_y(wheel), run->state().v_y(hub), 1e-6);
  // Angular momentum is kept.
  const double I2 = 1.0 / testing::inverse_mass(system, hub);
  EXPECT_NEAR(run->state().v_y(hub), 2.0 * 1.15e-3 / (1.15e-3 + I2), 1e-6);
}

}  // namespace
}  // namespace clatter::dynamics
