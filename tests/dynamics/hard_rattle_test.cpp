// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case T10: a piston that rattles between two dry walls.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "dynamics/run/energy.hpp"
#include "tests/dynamics/film/piston_scene.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kPeriod = 60e-3;  // of the side force: 2000 rpm [s]
constexpr int kSamples = 600;      // of a period

/// A dry contact on two short pads at the pin's height: the piston does not rock. 20 um of
/// clearance.
film::PistonLinerOptions walls(double loss_factor) {
  film::PistonLinerOptions options;
  options.effects = {false, true, true, false};
  options.cells_around = options.cells_along = 2;
  options.pad_span = 0.2;
  options.skirt_bottom = -10e-3;
  options.skirt_top = 10e-3;
  options.damping.loss_factor = loss_factor;
  return options;
}

struct Rattle {
  std::vector<double> velocity;  // at kSamples instants of each period [m/s]
  double residue = 0.0;
};

/// 2 kg that cannot rock, under 1400 N that change sides twice a period, as the side force of a
/// piston does.
Rattle rattle(double loss_factor, double tolerance, int periods) {
  System system;
  const auto model = testing::rigid_piston(2.0, 1e3, 9e-3);
  const int body = system.add_body(make_modal_body(model, {false, 0.0}));
  std::vector<int> pin;
  for (int dof = 0; dof < 6; ++dof) pin.push_back(system.coordinate(body, dof));
  film::PistonLinerBodies bodies;
  bodies.stroke = [](double) { return film::StrokeState{}; };
  system.add_element(std::make_unique<film::PistonLiner>(walls(loss_factor), bodies, pin));
  system.add_load({"side", body, system.bodies()[0].shapes.row(1).transpose(), [](double t) {
                     return 1400.0 * std::sin(2.0 * std::numbers::pi * t / kPeriod);
                   }});
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = 1e-4;
  options.accuracy.tolerance = tolerance;
  Dirk method(system, options);
  method.set_observer(&energy);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  method.start(0.0, rest, rest);
  Rattle result;
  for (int k = 1; k <= kSamples * periods; ++k) {
    const double instant = k * kPeriod / kSamples;
    while (method.state().time < instant) method.step(instant);
    result.velocity.push_back(method.state().v_y(pin[1]));
  }
  result.residue = energy.residue();
  return result;
}

/// Rms of the difference of two stretches of a period over the rms of the first.
double difference(const std::vector<double>& a, int at_a, const std::vector<double>& b, int at_b) {
  double change = 0.0, all = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    const double one = a[at_a * kSamples + k];
    change += std::pow(one - b[at_b * kSamples + k], 2);
    all += one * one;
  }
  return std::sqrt(change / all);
}

TEST(HardT10_DryRattle, RepeatsItsPeriodWhichAnElasticContactNeverDoes) {
  // Elastic, as before the damping: 1.4 and 1.5; damped: see below.
  const int periods = 4;
  for (const bool damped : {false, true}) {
    const double eta = damped ? film::ContactDampingOptions{}.loss_factor : 0.0;
    const Rattle run = rattle(eta, 2e-5, periods), finer = rattle(eta, 1e-5, periods);
    const double repeated = difference(run.velocity, periods - 1, run.velocity, periods - 2);
    const double agreed = difference(run.velocity, periods - 1, finer.velocity, periods - 1);
    std::printf(
        "T10 loss factor %.2f: velocities of the last two periods differ by %.1e, those of "
        "tolerances 2e-5 and 1e-5 by %.1e; energy residue %.1e\n",
        eta, repeated, agreed, run.residue);
    test::expect_at_most("energy residue", run.residue, 5e-4);
    if (damped) {
      test::expect_at_most("difference of two periods", repeated, 1e-4);  // 5e-6 is reached
      EXPECT_LT(agreed, 0.05);
    } else {
      EXPECT_GT(repeated, 0.5);
      EXPECT_GT(agreed, 0.5);
    }
  }
}

}  // namespace
}  // namespace clatter::dynamics
