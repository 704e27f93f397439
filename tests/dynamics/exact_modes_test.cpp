// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that move free modes exactly.
#include "dynamics/integrate/exact_mode.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics {
namespace {

using testing::point_mass;
using testing::vector;
using Complex = std::complex<double>;

constexpr double kDiagonal = 0.29289321881345248;

/// What a step multiplies x' = lambda x by.
Complex multiplier(Complex z) {
  const Complex denominator = 1.0 - kDiagonal * z;
  return (1.0 + (1.0 - 2.0 * kDiagonal) * z) / (denominator * denominator);
}

TEST(ExactMode, AStepMultipliesByTheExponentialOfTheEigenvalue) {
  for (const double zeta : {0.0, 1e-4, 0.02, 0.5}) {
    for (const double turn : {1e-6, 1e-3, 0.1, 1.0, 2.0, 2.4}) {
      const double dt = 1e-5, omega = turn / dt / std::sqrt(1.0 - zeta * zeta);
      const Complex lambda(-zeta * omega, turn / dt);
      const ExactMode fit = exact_mode(omega * omega, 2.0 * zeta * omega, dt, kDiagonal);
      const Complex found = multiplier(dt * (fit.alpha + fit.beta * lambda));
      EXPECT_LT(std::abs(found - std::exp(dt * lambda)), 1e-15 * (1.0 + 10.0 * turn))
          << zeta << " " << turn;
    }
  }
}

TEST(ExactMode, WithoutDampingChangesFallWithTheStepToTheThirdAndSecondPower) {
  const auto fit = [](double dt) { return exact_mode(1e8, 0.0, dt, kDiagonal); };
  const ExactMode coarse = fit(2e-5), fine = fit(1e-5);
  EXPECT_NEAR((coarse.beta - 1.0) / (fine.beta - 1.0), 4.0, 0.2);
  EXPECT_NEAR(coarse.alpha / fine.alpha, 8.0, 0.8);
}

TEST(ExactMode, RigidOverdampedAndFastModesAreAsTheMethodHasThem) {
  for (const ExactMode& fit :
       {exact_mode(0.0, 0.0, 1e-5, kDiagonal), exact_mode(0.0, 5.0, 1e-5, kDiagonal),
        exact_mode(1.0, 5.0, 1e-5, kDiagonal), exact_mode(1e12, 0.0, 1e-5, kDiagonal)}) {
    EXPECT_EQ(fit.alpha, 0.0);
    EXPECT_EQ(fit.beta, 1.0);
  }
}

/// A 1 kg mass on a spring, with a load, started with x and v.
struct Oscillator {
  System system;
  double omega, delta;

  Oscillator(double stiffness, double damping) : omega(std::sqrt(stiffness)), delta(damping) {
    system.add_body(point_mass(1.0, stiffness, damping));
  }
  void load(std::function<double(double)> value) {
    system.add_load({"load", 0, vector(1.0), std::move(value)});
  }
  /// x after `end` [s] in steps of `dt`.
  double run(const Tableau& method, double dt, double end, double x, double v, bool exact = true) {
    const int y = system.coordinate(0, 0);
    StepOptions options;
    options.method = &method;
    options.largest = dt;
    options.first = 1e-12;
    options.fixed = true;
    options.exact_modes = exact;
    const auto integrator = make_integrator(system, options);
    integrator->start(-options.first, vector(x), vector(v));
    while (integrator->state().time < end - 1e-12) integrator->step(end);
    return integrator->state().y(y);
  }
  /// Without load.
  double free(double t, double x, double v) const {
    const double decay = 0.5 * delta, turn = std::sqrt(omega * omega - decay * decay);
    return std::exp(-decay * t) *
           (x * std::cos(turn * t) + (v + decay * x) / turn * std::sin(turn * t));
  }
};

TEST(ExactModes, AFreeOscillatorIsExactAtAnyStep) {
  for (const Tableau* method : {&sdirk2(), &tr_bdf2()}) {
    for (const double dt : {1e-3, 7e-3, 0.05, 0.11}) {  // up to 2.2 rad
      Oscillator one(400.0, 0.4);
      EXPECT_NEAR(one.run(*method, dt, 7.7, 1e-3, 0.02), one.free(7.7, 1e-3, 0.02), 2e-13)
          << method->name << " " << dt;
    }
  }
}

TEST(ExactModes, UnderAConstantForceTheDeviationFromEquilibriumIsExact) {
  for (const Tableau* method : {&sdirk2(), &tr_bdf2()}) {
    Oscillator one(400.0, 0.4);
    one.load([](double) { return 2.0; });
    const double rest = 2.0 / 400.0;
    EXPECT_NEAR(one.run(*method, 0.05, 7.7, 0.0, 0.0), rest + one.free(7.7, -rest, 0.0), 5e-12)
        << method->name;
  }
}

TEST(ExactModes, UnderAVaryingForceTheOrderIsTwo) {
  // x'' + 0.4 x' + 400 x = 2 sin 31 t; the particular motion by its complex amplitude.
  const double w = 31.0;
  const Complex amplitude = 2.0 / Complex(400.0 - w * w, 0.4 * w);
  for (const Tableau* method : {&sdirk2(), &tr_bdf2()}) {
    double error[3];
    for (int k = 0; k < 3; ++k) {
      Oscillator one(400.0, 0.4);
      one.load([&](double t) { return 2.0 * std::sin(w * t); });
      const double end = 1.0;
      const double exact = (amplitude * std::polar(1.0, w * end)).imag() +
                           one.free(end, -amplitude.imag(), -(amplitude * w).real());
      error[k] = std::abs(one.run(*method, 4e-3 / (1 << k), end, 0.0, 0.0) - exact);
    }
    EXPECT_NEAR(error[0] / error[1], 4.0, 0.4) << method->name;
    EXPECT_NEAR(error[1] / error[2], 4.0, 0.2) << method->name;
  }
}

TEST(ExactModes, AModeThatRingsAfterAnImpactKeepsItsAmplitude) {
  const double omega = 2.0 * std::numbers::pi * 4000.0;
  const auto largest = [&](bool exact) {
    double found = 0.0;
    for (int later = 0; later < 6; ++later) {
      Oscillator one(omega * omega, 0.0);
      const double end = 0.01 + 4e-5 * later;
      found = std::max(found, std::abs(one.run(sdirk2(), 4e-5, end, 0.0, 1.0, exact) * omega));
    }
    return found;
  };
  EXPECT_GT(largest(true), 0.95);  // of samples 1 rad apart
  EXPECT_LT(largest(false), 0.5);  // 0.9968^250
}

TEST(ExactModes, AFastModeStaysDamped) {
  Oscillator one(1e10, 0.0);  // 10 rad in a step: amplitude 0.6 after one, 0.02 after eight
  EXPECT_LT(std::abs(one.run(sdirk2(), 1e-4, 4e-3, 1.0, 0.0)), 1e-3);
}

}  // namespace
}  // namespace clatter::dynamics
