// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases B1 and N3: high frequencies of a reduced body must not limit the step.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using testing::clamped_bar;

/// Tip displacement over 2 ms after a force of 1 kN is put on the tip, every 20 us.
std::vector<double> tip_response(int modes) {
  System system;
  const int y =
      system.coordinate(system.add_body(make_modal_body(clamped_bar(1.0, 400, modes), {})), 0);
  testing::push(system, [](double t) { return 1e3 * std::min(t / 2e-4, 1.0); });
  StepOptions options;
  options.largest = 5e-6;
  options.first = 1e-9;
  options.fixed = true;
  Dirk method(system, options);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.modes());
  method.start(-options.first, rest, rest);
  std::vector<double> tip;
  while (method.state().time < 2e-3 - 1e-9) {
    for (int i = 0; i < 4; ++i) method.step(1.0);
    tip.push_back(method.state().y(y));
  }
  return tip;
}

/// The continuum: static minus sum of modes for the ramped force (Duhamel).
double exact_tip(double t) {
  const double EA = 210e9 * 1e-4, c = std::sqrt(210e9 / 7850.0), rho_A = 7850.0 * 1e-4, T = 2e-4;
  double u = 1e3 * std::min(t / T, 1.0) / EA;
  for (int i = 1; i < 400; ++i) {
    const double w = (2 * i - 1) * std::numbers::pi * c / 2.0;
    const double a = 2.0 * 1e3 / (rho_A * w * w * w * T);
    u -= a * (t < T ? std::sin(w * t) : std::sin(w * t) - std::sin(w * (t - T)));
  }
  return u;
}

TEST(HardB1_AnyNumberOfModes, GivesTheSameLowResponseWithoutSmallerSteps) {
  const auto none = tip_response(0), some = tip_response(20), many = tip_response(200);
  double largest = 0.0, few_error = 0.0, many_error = 0.0, mode_gap = 0.0;
  for (size_t i = 0; i < many.size(); ++i) {
    const double exact = exact_tip(2e-5 * static_cast<double>(i + 1));
    largest = std::max(largest, std::abs(exact));
    few_error = std::max(few_error, std::abs(none[i] - exact));
    many_error = std::max(many_error, std::abs(many[i] - exact));
    mode_gap = std::max(mode_gap, std::abs(many[i] - some[i]));
  }
  // 200 modes reach 250 kHz, fifty times beyond 1 / dt resolution: still stable at the same step.
  test::expect_at_most("error with 200 modes", many_error / largest, 0.02);
  test::expect_at_most("difference of 20 and 200 modes", mode_gap / largest, 5e-4);
  EXPECT_LT(few_error, 0.6 * largest);  // Guyan: right in the mean, without the waves
}

/// A push that swings between 0 and 1 kN in straight lines of 1 ms.
double zigzag(double t) {
  const double phase = std::fmod(std::max(t, 0.0) * 1e3, 2.0);
  return 1e3 * (phase < 1.0 ? phase : 2.0 - phase);
}

struct Zigzag {
  long long steps = 0;
  std::vector<double> tip;  // every 0.1 ms
};

/// A bar under the zigzag with the modes above `limit` [Hz] quasi-static, or left out.
Zigzag under_zigzag(double limit, bool left_out) {
  ModalBody bar = make_modal_body(clamped_bar(1.0, 100, 20), {true, limit});
  if (left_out) {
    const auto kept = static_cast<Eigen::Index>(bar.inertia.sum());
    bar.shapes = bar.shapes.leftCols(kept).eval();
    for (auto* values : {&bar.omega_squared, &bar.damping, &bar.inertia})
      values->conservativeResize(kept);
  }
  System system;
  const int y = system.coordinate(system.add_body(std::move(bar)), 0);
  testing::push(system, zigzag);
  StepOptions options;
  options.smallest = 1e-13;
  Dirk method(system, options);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.modes());
  method.start(0.0, rest, rest);
  Zigzag result;
  for (int i = 1; i <= 50; ++i) {
    while (method.state().time < 1e-4 * i) method.step(1e-4 * i);
    result.tip.push_back(method.state().y(y));
  }
  result.steps = method.statistics().accepted;
  return result;
}

TEST(HardN3_QuasiStaticModes, DoNotShortenTheSteps) {
  const double limit = 3000.0;  // one mode has inertia
  const Zigzag with = under_zigzag(limit, false), without = under_zigzag(limit, true);
  std::printf("    %lld steps with quasi-static modes, %lld without\n", with.steps, without.steps);
  test::expect_at_most("steps, of those without such modes",
                       static_cast<double>(with.steps) / static_cast<double>(without.steps), 1.05);
  // Their share of the displacement is the static one at any instant.
  const ModalBody bar = make_modal_body(clamped_bar(1.0, 100, 20), {true, limit});
  double flexibility = 0.0;
  for (int k = 1; k < bar.modes(); ++k)
    flexibility += bar.shapes(0, k) * bar.shapes(0, k) / bar.omega_squared(k);
  for (size_t i = 0; i < with.tip.size(); ++i) {
    const double share = flexibility * zigzag(1e-4 * static_cast<double>(i + 1));
    EXPECT_NEAR(with.tip[i] - without.tip[i], share, 1e-7);
  }
}

/// Steps over three periods of an oscillator of 100 kg, beside a mass at rest.
long long steps_beside(double mass) {
  System system;
  system.coordinate(system.add_body(testing::point_mass(100.0, 4e4)), 0);
  if (mass > 0.0) system.coordinate(system.add_body(testing::point_mass(mass)), 0);
  StepOptions options;
  options.largest = 0.1;
  options.accuracy = {1e-4, 1e-3, 2e-2, 1.0};
  Dirk method(system, options);
  Eigen::VectorXd eta = Eigen::VectorXd::Zero(system.modes());
  eta(0) = 1e-3 * std::sqrt(100.0);
  method.start(0.0, eta, Eigen::VectorXd::Zero(system.modes()));
  while (method.state().time < 1.0) method.step(1.0);
  return method.statistics().accepted;
}

TEST(HardN8_LightestBody, DoesNotTightenTheToleranceOfTheOthers) {
  // With one limit for all it took 6.8 times as many steps beside a gram: (1e5)^(1/6).
  EXPECT_EQ(steps_beside(1e-3), steps_beside(0.0));
}

}  // namespace
}  // namespace clatter::dynamics
