// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case B1: high frequencies of a reduced body must not limit the step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/synthetic.hpp"

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
  EXPECT_LT(many_error, 0.02 * largest);
  EXPECT_LT(mode_gap, 5e-4 * largest);
  EXPECT_LT(few_error, 0.6 * largest);  // Guyan: right in the mean, without the waves
}

}  // namespace
}  // namespace clatter::dynamics
